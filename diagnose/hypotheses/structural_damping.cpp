#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis structural_damping(const Scales& scales) {
  const double scale_rad_per_s = arm::omega_scale_rad_per_s(scales.beam);
  return {
      .effect = "structural_damping",
      .parameters = {{"time", 1e-3 / scale_rad_per_s, 1.0 / scale_rad_per_s, Spacing::from_zero}},
      .shows = Shows::in_all,
      .speaks_for = "damping ratios rise in proportion to the frequency of the mode",
      .refuted_by = "damping ratios that fall with frequency"};
}

}  // namespace flexarm::diagnose
