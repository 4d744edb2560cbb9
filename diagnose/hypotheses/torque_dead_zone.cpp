#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis torque_dead_zone(const Scales& scales) {
  return {.effect = "torque_dead_zone",
          .parameters = {{"width", 1e-3 * scales.torque_peak_N_m, 0.8 * scales.torque_peak_N_m,
                          Spacing::from_zero}},
          .shows = Shows::in_time,
          .speaks_for = "runs of low torque misfit most: the gain rises with the amplitude",
          .refuted_by = "a gain that is the same at every amplitude"};
}

}  // namespace flexarm::diagnose
