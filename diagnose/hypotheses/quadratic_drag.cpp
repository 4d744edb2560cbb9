#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis quadratic_drag(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  // As heavy as the beam's inertia over the way of its tip.
  const double natural = beam.linear_density_kg_per_m / beam.length_m;
  return {.effect = "quadratic_drag",
          .parameters = {{"coefficient", 1e-3 * natural, 30.0 * natural, Spacing::from_zero}},
          .shows = Shows::in_time,
          .speaks_for = "damping grows with the amplitude",
          .refuted_by = "damping that is the same at every amplitude"};
}

}  // namespace flexarm::diagnose
