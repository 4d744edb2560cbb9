#include "diagnose/hypotheses/hypotheses.hpp"

#include <numbers>

namespace flexarm::diagnose {

Hypothesis torque_ripple(const Scales& scales) {
  return {.effect = "torque_ripple",
          .parameters = {{"amplitude", 3e-3 * scales.torque_rms_N_m, scales.torque_rms_N_m,
                          Spacing::from_zero},
                         {"cycles", 2.0, 40.0},
                         {"phase", 0.0, 2.0 * std::numbers::pi, Spacing::linear, true}},
          .shows = Shows::in_time,
          // Of few cycles, over a part of a turn.
          .contains = {"hub_spring", "torque_bias"},
          .speaks_for = "residual torque comes back with the hub angle",
          .refuted_by = "residual torque at one angle that differs from turn to turn"};
}

}  // namespace flexarm::diagnose
