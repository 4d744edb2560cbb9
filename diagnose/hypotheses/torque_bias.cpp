#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis torque_bias(const Scales& scales) {
  return {.effect = "torque_bias",
          .parameters = {{.name = "torque",
                          .lowest = -scales.torque_rms_N_m,
                          .highest = scales.torque_rms_N_m,
                          .spacing = Spacing::linear,
                          .neutral = 0.0}},
          .shows = Shows::in_time,
          .speaks_for = "residual torque is constant: the arm drifts one way",
          .refuted_by = "no drift where the torque is zero"};
}

}  // namespace flexarm::diagnose
