// Ice that is very soft or stiff, nearly incompressible, without strength, thin, or disordered.
#include "cases/stability/row_list.hpp"

namespace nilas::cases {

namespace {

void add_stiffness(RowList& list) {
  list.begin("ice stiffness", "hcc-oblique", kCoarseSheet);
  list.add("x 0.01", {"ice.material.young_modulus_Pa=9.38e7"});
  list.add("x 0.1", {"ice.material.young_modulus_Pa=9.38e8"});
  list.add("x 1", {"ice.material.young_modulus_Pa=9.38e9"});
  list.add("x 10", {"ice.material.young_modulus_Pa=9.38e10"});
  list.add("x 100", {"ice.material.young_modulus_Pa=9.38e11", "run.end_time_s=5e-4"});

  list.begin("Poisson ratio", "hcc-oblique", kCoarseSheet);
  const auto poisson = [](const std::string& value) { return "ice.material.poisson_ratio=" + value; };
  for (const char* value : {"0", "0.33", "0.49"}) list.add(value, {poisson(value)});
  list.add("0.499", {poisson("0.499"), "run.end_time_s=5e-4"});
  list.add("0.4999", {poisson("0.4999"), "run.end_time_s=3e-4"});
  list.add_long("0.4999, 1.5 ms", {poisson("0.4999")});
  list.add("0.5", {poisson("0.5")});
}

void add_strength(RowList& list) {
  list.begin("ice strength", "hcc-oblique", kCoarseSheet);
  list.add("cohesion 0", {"ice.material.cohesion_Pa=0"});
  list.add("friction 0 deg", {"ice.material.friction_angle_deg=0", "ice.material.dilation_angle_deg=0"});
  list.add("cohesion 0, friction 0",
           {"ice.material.cohesion_Pa=0", "ice.material.friction_angle_deg=0", "ice.material.dilation_angle_deg=0"});
  list.add("friction 60 deg", {"ice.material.friction_angle_deg=60"});
  list.add("dilation above friction", {"ice.material.friction_angle_deg=10", "ice.material.dilation_angle_deg=12"});
  list.remedy({"ice.material.dilation_angle_deg=10"});
  list.add("dilation 36 deg, plastic", {"ice.material.dilation_angle_deg=36", "ice.material.after_failure=plastic"});
  list.add("cohesionless after failure", {"ice.material.after_failure=cohesionless"});
  list.add("cohesion 1e12 Pa", {"ice.material.cohesion_Pa=1e12"});
}

void add_layers(RowList& list) {
  list.begin("layers of particles", "hcc-oblique", kCoarseSheet);
  list.add("1", {"ice.thickness_m=0.0375"});
  list.add("2", {"ice.thickness_m=0.075"});
  list.add("3", {"ice.thickness_m=0.1125"});
}

void add_disorder(RowList& list) {
  list.begin("jitter in spacings", "hcc-oblique", kCoarseSheet);
  for (const char* value : {"0.1", "0.2", "0.3", "0.4", "0.5"}) list.add(value, {std::string("ice.jitter=") + value});
  list.add("0.5, corrected gradient", {"ice.jitter=0.5", "numerics.gradient_correction=true"});

  const std::string block = "{shape=\"block\",size_m=[0.75,0.75,0.3],spacing_m=0.0375,centre_m=[0,0,";
  list.begin("pieces of ice on top of each other", "hcc-oblique", {"run.end_time_s=0.0015", "output.interval_s=5e-4"});
  list.add("exactly", {"ice=[" + block + "0]}," + block + "0]}]"});
  list.add("by 0.6 spacings", {"ice=[" + block + "0]}," + block + "0.2775]}]"});
  list.add("side by side", {"ice=[" + block + "0]}," + block + "0.3]}]"});
}

}  // namespace

void add_ice_rows(RowList& list) {
  add_stiffness(list);
  add_strength(list);
  add_layers(list);
  add_disorder(list);
}

}  // namespace nilas::cases
