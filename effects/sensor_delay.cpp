#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry sensor_delay() {
  return {
      .definition = define(
          {.name = "sensor_delay",
           .meaning = "reading(t) = value(t - delay) of that sensor; default "
                      "`tip_acceleration`",
           .parameters = {{.name = "delay",
                           .unit = "s",
                           .range = arm::kNotNegative,
                           .meaning = "delay of that sensor",
                           .example = 0.005,
                           .neutral = 0.0}},
           .sensor = arm::Sensor{arm::SensorKind::tip_acceleration, 0.0},
           .sensor_path =
               [](const arm::Effect& effect) {
                 return arm::SensorStage{effect.acting_sensor(), arm::Delay{effect.value("delay")}};
               }}),
      .shows = Shows::in_time_and_frequency,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        // Fine enough that a scan of some 40 values finds a delay of many samples: it shows only
        // within a part of a period of what the sensor reads.
        return {{"delay", 20.0 * scales.shortest_time_s, 400.0 * scales.shortest_time_s,
                 Spacing::from_zero}};
      },
      .prior = Likely::common,
      .family = Family::timing,
      .speaks_for =
          "phase lag proportional to frequency in one sensor only; its magnitude unchanged",
      .refuted_by =
          "the same delay in the other sensors (that is a time delay of the torque), or a "
          "magnitude that falls with frequency (that is a lag)"};
}

}  // namespace flexarm::effects
