// What no scene can mean: each is to be refused before anything is written, and never to run forever.
#include "cases/stability/row_list.hpp"

namespace nilas::cases {

void add_input_rows(RowList& list) {
  list.begin("input", "hcc-oblique", kCoarseSheet);
  for (const char* override_ : {"impact.speed_m_s=nan",
                                "ice.spacing_m=inf",
                                "ice.material.density_kg_m3=-900",
                                "body.0.mass_kg=0",
                                "impact.speed_m_s=1e300",
                                "impact.speed_m_s=3e8",
                                "body.0.mass_kg=1e300",
                                "ice.diameter_m=1e300",
                                "ice.spacing_m=1e-300",
                                "ice.material.young_modulus_Pa=1e300",
                                "ice.material.young_modulus_Pa=1e-300",
                                "ice.material.density_kg_m3=1e300",
                                "ice.material.density_kg_m3=1e-300",
                                "numerics.cfl=1e-300",
                                "numerics.max_step_s=1e-300",
                                "numerics.viscosity_alpha=1e300",
                                "contact.stiffness=1e300",
                                "contact.damping=1e300",
                                "run.end_time_s=1e300",
                                "output.interval_s=1e-300",
                                "body.0.spacing_m=1e-300",
                                "ice.centre_m=[0,0,1e300]",
                                "body.0.angular_velocity_rad_s=[1e300,0,0]",
                                "body.0.length_m=1e300",
                                "run.gravity_m_s2=[0,0,1e300]",
                                "ice.material.cohesion_Pa=1e300",
                                "contact.friction_coefficient=1e300"})
    list.add(override_, {override_});
}

}  // namespace nilas::cases
