#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis stribeck_friction(const Scales& scales) {
  return {.effect = "stribeck_friction",
          .parameters = {{"torque", 3e-3 * scales.torque_rms_N_m, 2.0 * scales.torque_rms_N_m,
                          Spacing::from_zero},
                         {"static_torque", 3e-3 * scales.torque_rms_N_m,
                          4.0 * scales.torque_rms_N_m, Spacing::from_zero},
                         {"velocity", 3e-3 * scales.speed_rms_rad_per_s,
                          3.0 * scales.speed_rms_rad_per_s}},
          .shows = Shows::in_time,
          .contains = {"coulomb_friction"},
          .speaks_for = "residual torque is a step against hub velocity that is highest at rest",
          .refuted_by = "a step of one height at every velocity"};
}

}  // namespace flexarm::diagnose
