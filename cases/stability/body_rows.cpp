// Bodies that are very light or heavy, turn fast, or have hardly any inertia.
#include "cases/stability/row_list.hpp"

namespace nilas::cases {

namespace {

std::string coupling(const std::string& number) { return "numerics.max_coupling_number=" + number; }

/// The number counts the whole surface and the tip touches with a few particles, so larger ones than 1 hold here; a
/// light body is thrown off at once, so that the first touch is all there is to see.
void add_masses(RowList& list) {
  const Overrides first_touch{"impact.gap_m=0.001", "run.end_time_s=1e-4"};
  list.begin("body mass", "hcc-oblique", with(kCoarseSheet, first_touch));
  list.add("1 g", {"body.0.mass_kg=0.001"});
  list.remedy({coupling("1000")});
  list.add("10 g", {"body.0.mass_kg=0.01"});
  list.remedy({coupling("300")});
  list.add("0.1 kg", {"body.0.mass_kg=0.1"});
  list.remedy({coupling("30")});
  list.add("1 kg", {"body.0.mass_kg=1"});
  list.remedy({coupling("1")});
  list.begin("body mass", "hcc-oblique", kCoarseSheet);
  list.add("10 kg", {"body.0.mass_kg=10"});
  list.remedy({coupling("1")});
  list.add("174 kg", {"body.0.mass_kg=174"});
  list.add("1e3 kg", {"body.0.mass_kg=1e3"});
  list.add("1e5 kg", {"body.0.mass_kg=1e5"});
}

/// A mass pressed against a bar by its whole face, z A dt/m of the touching face; the run may be unstable (100), so
/// that one sees where it is. The box is four times as large as the face of the bar.
void add_coupling_numbers(RowList& list) {
  list.begin("coupling number of a full face", "bar-struck-by-mass",
             {"ice.size_m=[0.05,0.015,0.015]", "ice.centre_m=[-0.175,0,0]", "run.end_time_s=3e-5", coupling("100")});
  const auto mass = [](const char* kg) { return Overrides{std::string("body.0.mass_kg=") + kg}; };
  list.add("1.0", mass("3.29e-4"));
  list.add("1.5", mass("2.19e-4"));
  list.add("2.5", mass("1.316e-4"));
  list.remedy({coupling("6")});  // 1.5 of the touching face
  list.add("5", mass("6.58e-5"));
  list.remedy({coupling("6")});
}

void add_spins(RowList& list) {
  list.begin("spin about the axis", "hcc-oblique", kCoarseSheet);
  list.add("10 rad/s", {"body.0.angular_velocity_rad_s=[0,-5,8.660254]"});
  list.add("1e2 rad/s", {"body.0.angular_velocity_rad_s=[0,-50,86.60254]"});
  list.add("1e3 rad/s", {"body.0.angular_velocity_rad_s=[0,-500,866.0254]"});
  list.add("1e4 rad/s", {"body.0.angular_velocity_rad_s=[0,-5000,8660.254]"});
  // Towards the ice: at 1e4 rad/s the tip has 9.3 km/s.
  list.begin("spin across the axis", "hcc-oblique", kCoarseSheet);
  list.add("10 rad/s", {"body.0.angular_velocity_rad_s=[-10,0,0]"});
  list.add("1e2 rad/s", {"body.0.angular_velocity_rad_s=[-100,0,0]"});
  list.add("1e3 rad/s", {"body.0.angular_velocity_rad_s=[-1000,0,0]"});
  list.add("1e4 rad/s", {"body.0.angular_velocity_rad_s=[-10000,0,0]"});
}

void add_inertias(RowList& list) {
  list.begin("inertia", "hcc-oblique", with(kCoarseSheet, {"body.0.mass_kg=174.1"}));
  list.add("zero about the axis", {"body.0.inertia_kg_m2=[21.4,21.4,0]"});
  list.add("against the triangle inequality", {"body.0.inertia_kg_m2=[1,1,6]"});
  list.add("too large for the shape, printed", {"body.0.inertia_kg_m2=[21.4,21.4,6.15]"});
  list.add("needle", {"body.0.inertia_kg_m2=[47.2,47.2,1e-6]"});
  list.add("point mass", {"body.0.inertia_kg_m2=[1e-6,1e-6,1e-6]"});
}

}  // namespace

void add_body_rows(RowList& list) {
  add_masses(list);
  add_coupling_numbers(list);
  add_spins(list);
  add_inertias(list);
}

}  // namespace nilas::cases
