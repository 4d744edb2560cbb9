#include "effects/registry/entry.hpp"

#include <algorithm>

namespace flexarm::effects {

Entry sensor_lag() {
  return {.definition = define({.name = "sensor_lag",
                                .meaning = "first-order lag 1 / (1 + time_constant s) of that "
                                           "sensor; default `tip_acceleration`",
                                .parameters = {{.name = "time_constant",
                                                .unit = "s",
                                                .range = arm::kNotNegative,
                                                .meaning = "time constant of the lag",
                                                .example = 0.002,
                                                .neutral = 0.0}},
                                .sensor = arm::Sensor{arm::SensorKind::tip_acceleration, 0.0},
                                .sensor_path =
                                    [](const arm::Effect& effect) {
                                      return arm::SensorStage{
                                          effect.acting_sensor(),
                                          arm::Lag{effect.value("time_constant")}};
                                    }}),
          .shows = Shows::in_time_and_frequency,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            return {{"time_constant", 0.02 * scales.shortest_time_s,
                     std::min(1000.0 * scales.shortest_time_s, scales.longest_lag_s()),
                     Spacing::from_zero}};
          },
          .prior = Likely::common,
          .family = Family::timing,
          .speaks_for = "phase lag and magnitude roll-off in one sensor only",
          .refuted_by = "the same phase lag in other sensors"};
}

}  // namespace flexarm::effects
