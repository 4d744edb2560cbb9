#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis coulomb_friction(const Scales& scales) {
  return {.effect = "coulomb_friction",
          .parameters = {{"torque", 3e-3 * scales.torque_rms_N_m, 2.0 * scales.torque_rms_N_m,
                          Spacing::from_zero}},
          .shows = Shows::in_time,
          .speaks_for =
              "residual torque is a step against hub velocity, and damping falls with "
              "the amplitude",
          .refuted_by = "damping that is the same at every amplitude"};
}

}  // namespace flexarm::diagnose
