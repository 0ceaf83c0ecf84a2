// Steps that are too long, and runs that are: at rest for a million steps, far from the origin, in a fast frame.
#include "cases/stability/row_list.hpp"

namespace nilas::cases {

namespace {

void add_cfl(RowList& list) {
  const auto cfl = [](const std::string& value) { return "numerics.cfl=" + value; };
  list.begin("CFL", "hcc-oblique", kCoarseSheet);
  for (const char* value : {"0.2", "0.4", "0.6", "0.8", "1.0"}) list.add(value, {cfl(value)});
  list.add("1.2", {cfl("1.2")});
  list.add("1.5", {cfl("1.5")});
  list.remedy({cfl("0.6")});
  list.add("5", {cfl("5")});
  list.remedy({cfl("0.6")});
  // Unbreakable ice without viscosity hides nothing.
  list.begin("CFL of an elastic bar", "bar-on-wall", {"run.end_time_s=0.001", "output.interval_s=5e-4"});
  for (const char* value : {"0.6", "0.8", "1.0", "1.2", "1.5"}) list.add(value, {cfl(value)});
  list.remedy({cfl("0.6")});
}

/// 125 particles, steps of 0.76 us.
void add_rest(RowList& list) {
  const Overrides block{"ice.size_m=[0.0125,0.0125,0.0125]", "ice.periodic=[]", "ice.velocity_m_s=[0,0,0]",
                        "output.history_interval_s=1e-4", "output.interval_s=2"};
  const Overrides on_wall{"ice.centre_m=[0.09375,0,0]"};
  const Overrides gravity{"run.gravity_m_s2=[9.81,0,0]"};
  list.begin("at rest", "bar-on-wall", block);
  list.add("out of touch, 1e5 steps", {"run.end_time_s=0.076"});
  list.add_long("out of touch, 1e6 steps", {"run.end_time_s=0.76"});
  list.begin("at rest", "bar-on-wall", with(block, on_wall));
  list.add("touching a wall without gravity, 1e4 steps", {"run.end_time_s=0.0076"});
  list.begin("at rest", "bar-on-wall", with(block, with(on_wall, gravity)));
  list.add("lying on a wall, 1e5 steps", {"run.end_time_s=0.076"});
  list.add_long("lying on a wall, 1e6 steps", {"run.end_time_s=0.76"});
  list.add("disordered on a wall, 1e4 steps", {"run.end_time_s=0.0076", "ice.jitter=0.3", "ice.centre_m=[0.093,0,0]"});
}

void add_frames(RowList& list) {
  list.begin("far from the origin", "hcc-oblique", kCoarseSheet);
  list.add("1e6 m", {"ice.centre_m=[1e6,1e6,1e6]"});
  list.begin("fast frame", "bar-struck-by-mass",
             {"ice.fixed=none", "ice.size_m=[0.1,0.015,0.015]", "ice.centre_m=[-0.15,0,0]", "run.end_time_s=1e-4"});
  list.add("0 m/s", {});
  list.add("1 km/s", {"ice.velocity_m_s=[1000,0,0]", "body.0.velocity_m_s=[1001,0,0]"});
}

}  // namespace

void add_numerics_rows(RowList& list) {
  add_cfl(list);
  add_rest(list);
  add_frames(list);
}

}  // namespace nilas::cases
