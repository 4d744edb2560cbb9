#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis sensor_lag(const Scales& scales, const arm::Sensor& sensor) {
  return {.effect = "sensor_lag",
          .sensor = arm::to_string(sensor),
          .parameters = {{"time_constant", 0.02 * scales.shortest_time_s,
                          200.0 * scales.shortest_time_s, Spacing::from_zero}},
          .shows = Shows::in_time_and_frequency,
          .speaks_for = "one sensor falls behind, the others do not",
          .refuted_by = "other sensors that fall behind as much"};
}

}  // namespace flexarm::diagnose
