#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry sensor_lag() {
  return {.definition = define({.name = "sensor_lag",
                                .meaning = "that sensor reads through 1 / (1 + time_constant s); "
                                           "`tip_acceleration` unless given",
                                .parameters = {{.name = "time_constant",
                                                .unit = "s",
                                                .range = arm::kNotNegative,
                                                .meaning = "of the first-order lag",
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
            return {{"time_constant", 0.02 * scales.shortest_time_s, 200.0 * scales.shortest_time_s,
                     Spacing::from_zero}};
          },
          .speaks_for = "one sensor lags, the others do not",
          .refuted_by = "other sensors that lag as much"};
}

}  // namespace flexarm::effects
