#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry sensor_gain() {
  return {
      .definition = define(
          {.name = "sensor_gain",
           .meaning = "reading = factor times the value; default `tip_acceleration`",
           .parameters = {{.name = "factor",
                           .unit = "1",
                           .range = arm::kAnyFinite,
                           .meaning = "gain of that sensor",
                           .example = 1.15,
                           .neutral = 1.0}},
           .sensor = arm::Sensor{arm::SensorKind::tip_acceleration, 0.0},
           .sensor_path =
               [](const arm::Effect& effect) {
                 return arm::SensorStage{effect.acting_sensor(), arm::Gain{effect.value("factor")}};
               }}),
      .shows = Shows::in_time_and_frequency,
      .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
        return {{.name = "factor", .lowest = 0.2, .highest = 5.0, .neutral = 1.0}};
      },
      .prior = Likely::common,
      .usual_deviation = 0.1,
      .family = Family::sensor,
      .speaks_for =
          "one sensor scaled by the same ratio at all frequencies; poles, zeros and the other "
          "sensors unchanged",
      .refuted_by = "the same ratio in the other sensors (that is a torque gain)"};
}

}  // namespace flexarm::effects
