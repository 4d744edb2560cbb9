#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis hub_spring(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  const double bending = beam.flexural_rigidity_N_m2 / beam.length_m;
  return {.effect = "hub_spring",
          .parameters = {{"stiffness", 1e-4 * bending, 3.0 * bending, Spacing::from_zero}},
          .shows = Shows::in_all,
          .speaks_for = "the hub comes back: residual torque is a slope against hub angle",
          .refuted_by = "a hub angle that stays where it is left"};
}

}  // namespace flexarm::diagnose
