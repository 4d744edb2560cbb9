#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis torque_saturation(const Scales& scales) {
  return {.effect = "torque_saturation",
          .parameters = {{.name = "limit",
                          .lowest = 0.05 * scales.torque_peak_N_m,
                          .highest = scales.torque_peak_N_m,
                          .neutral = scales.torque_peak_N_m}},
          .shows = Shows::in_time,
          .speaks_for = "only runs of high torque misfit, when it is highest",
          .refuted_by = "a misfit where the torque is low"};
}

}  // namespace flexarm::diagnose
