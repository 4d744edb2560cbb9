#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry sensor_offset() {
  return {.definition = define({.name = "sensor_offset",
                                .meaning = "`value` is added to the reading of that sensor; "
                                           "default `tip_acceleration`",
                                .parameters = {{.name = "value",
                                                .unit = std::string(kSensorUnit),
                                                .range = arm::kAnyFinite,
                                                .meaning = "constant that is added to the reading",
                                                .example = 0.2,
                                                .neutral = 0.0}},
                                .sensor = arm::Sensor{arm::SensorKind::tip_acceleration, 0.0},
                                .sensor_path =
                                    [](const arm::Effect& effect) {
                                      return arm::SensorStage{effect.acting_sensor(),
                                                              arm::Offset{effect.value("value")}};
                                    }}),
          .shows = Shows::in_time,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            return {{.name = "value",
                     .lowest = -2.0 * scales.reading_rms,
                     .highest = 2.0 * scales.reading_rms,
                     .spacing = Spacing::linear,
                     .neutral = 0.0}};
          },
          .applies = [](const Scales& scales) { return scales.reading_rms > 0.0; },
          .prior = Likely::common,
          .family = Family::sensor,
          .speaks_for = "a constant error of one sensor, the same in all runs",
          .refuted_by = "an error that grows with time or is absent while the arm rests"};
}

}  // namespace flexarm::effects
