// How a body meets the ice: slowly, fast, grazing, from inside, through a stiff or a soft contact.
#include "cases/stability/row_list.hpp"

namespace nilas::cases {

namespace {

void add_speeds(RowList& list) {
  list.begin("speed", "hcc-oblique", kCoarseSheet);
  // With no gap the round nose starts pressed against the ice by a fraction of a millimetre.
  list.add("0.01 m/s, touching", {"impact.speed_m_s=0.01", "impact.angle_deg=90", "impact.gap_m=0"});
  list.remedy({"impact.gap_m=2e-4", "run.end_time_s=0.01"});
  list.add_long("0.01 m/s, 0.1 s", {"impact.speed_m_s=0.01", "impact.angle_deg=90", "impact.gap_m=3e-4",
                                    "run.end_time_s=0.1", "output.interval_s=0.02"});
  list.add("1 m/s", {"impact.speed_m_s=1", "impact.angle_deg=90", "impact.gap_m=3e-4"});
  list.add("10 m/s", {"impact.speed_m_s=10", "impact.gap_m=0.001"});
  list.add("100 m/s", {});
  list.add("500 m/s", {"impact.speed_m_s=500", "run.end_time_s=5e-4"});
  list.add("1000 m/s", {"impact.speed_m_s=1000", "run.end_time_s=3e-4"});
  list.add("3000 m/s", {"impact.speed_m_s=3000", "run.end_time_s=1e-4"});
  list.remedy({"numerics.viscosity_beta=2"});
}

/// The highest point of the body is gap_m below the sheet, so a grazing body lies under the sheet along its side.
void add_angles(RowList& list) {
  list.begin("impact angle", "hcc-oblique", with(kCoarseSheet, {"impact.gap_m=5e-4"}));
  list.add("0.1 deg", {"impact.angle_deg=0.1", "run.end_time_s=0.004"});
  list.add("5 deg", {"impact.angle_deg=5"});
  list.add("30 deg", {"impact.angle_deg=30"});
  list.add("90 deg", {"impact.angle_deg=90"});
}

void add_overlaps(RowList& list) {
  list.begin("body starts inside the ice", "bar-struck-by-mass",
             {"ice.size_m=[0.1,0.015,0.015]", "ice.centre_m=[-0.15,0,0]", "run.end_time_s=5e-5"});
  list.add("by 0.25 spacings", {"body.0.position_m=[-0.209375,0,0]"});
  list.remedy({"body.0.position_m=[-0.21,0,0]"});
  list.add("by 1 spacing", {"body.0.position_m=[-0.2075,0,0]"});
  list.remedy({"body.0.position_m=[-0.21,0,0]"});
  list.add("by 5 spacings", {"body.0.position_m=[-0.1975,0,0]"});
  list.remedy({"body.0.position_m=[-0.21,0,0]"});
}

void add_contacts(RowList& list) {
  list.begin("contact stiffness", "hcc-oblique", kCoarseSheet);
  for (const char* value : {"0.02", "0.2", "2", "20"}) list.add(value, {std::string("contact.stiffness=") + value});
  list.begin("contact friction", "hcc-oblique", kCoarseSheet);
  list.add("0.3", {"contact.friction_coefficient=0.3"});
  list.add("10", {"contact.friction_coefficient=10"});
  list.add("stick", {"contact.stick=true"});
  list.begin("boundary spacing over ice spacing", "hcc-oblique", kCoarseSheet);
  list.add("0.25", {"body.0.spacing_m=0.009375"});
  list.add("1.56", {"body.0.spacing_m=0.0585"});
  list.add("4", {"body.0.spacing_m=0.15"});
}

}  // namespace

void add_impact_rows(RowList& list) {
  add_speeds(list);
  add_angles(list);
  add_overlaps(list);
  add_contacts(list);
}

}  // namespace nilas::cases
