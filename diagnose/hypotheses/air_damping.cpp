#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis air_damping(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  const double natural = beam.linear_density_kg_per_m * arm::omega_scale_rad_per_s(beam);
  return {.effect = "air_damping",
          .parameters = {{"coefficient", 1e-3 * natural, 3.0 * natural, Spacing::from_zero}},
          .shows = Shows::in_all,
          .speaks_for =
              "damping ratios fall in inverse proportion to the frequency of the "
              "mode, those of zeros too",
          .refuted_by = "damping ratios that rise with frequency"};
}

}  // namespace flexarm::diagnose
