#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis hub_viscous_friction(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  // Loses the energy of the arm that turns in the time of a swing at the scale of its modes.
  const double natural = arm::total_inertia_kg_m2(beam) * arm::omega_scale_rad_per_s(beam);
  return {.effect = "hub_viscous_friction",
          .parameters = {{"coefficient", 1e-3 * natural, natural, Spacing::from_zero}},
          .shows = Shows::in_all,
          .speaks_for =
              "residual torque is a slope against hub velocity, the same at every "
              "amplitude",
          .refuted_by = "a slope that changes with the amplitude, or a step at rest"};
}

}  // namespace flexarm::diagnose
