#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::effects {

namespace {

/// A gauge is not looked for further than this part of the beam's length from where it should be.
constexpr double kFurthest = 0.2;
/// Of the way to the tip: rounding does not take a gauge beyond it.
constexpr double kToTheTip = 1.0 - 1e-9;

void require_gauge(const arm::Effect& effect, const arm::Arm& /*arm*/) {
  const arm::Sensor sensor = effect.acting_sensor();
  if (sensor.kind == arm::SensorKind::strain) return;
  throw arm::InputError(
      fmt::format("effects.gauge_position.sensor: {} is no strain gauge; must be strain@X, X in m",
                  arm::to_string(sensor)),
      "effects.gauge_position.sensor");
}

}  // namespace

Entry gauge_position() {
  return {.definition =
              define({.name = "gauge_position",
                      .meaning = "the strain gauge `strain@X` is at X + shift; default "
                                 "`strain@0`",
                      .parameters = {{.name = "shift",
                                      .unit = "m",
                                      .range = arm::kAnyFinite,
                                      .meaning = "distance further from the beam root; "
                                                 "the gauge stays on the beam",
                                      .example = 0.05,
                                      .neutral = 0.0}},
                      .sensor = arm::Sensor{arm::SensorKind::strain, 0.0},
                      .sensor_place =
                          [](const arm::Effect& effect) {
                            return arm::SensorPlace{effect.acting_sensor(), effect.value("shift")};
                          },
                      .require_fit = require_gauge}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double length_m = scales.beam.length_m;
            const double position_m = scales.sensor ? scales.sensor->position_m : 0.0;
            return {{.name = "shift",
                     .lowest = -std::min(kFurthest * length_m, position_m),
                     .highest = std::min(kFurthest * length_m, kToTheTip * (length_m - position_m)),
                     .spacing = Spacing::linear,
                     .neutral = 0.0}};
          },
          .applies =
              [](const Scales& scales) {
                return scales.sensor && scales.sensor->kind == arm::SensorKind::strain;
              },
          .prior = Likely::rare,
          .family = Family::sensor,
          .speaks_for = "zeros of one strain gauge shifted; poles and the other sensors unchanged",
          .refuted_by =
              "an error of that gauge in the same ratio at all frequencies (that is a sensor "
              "gain)"};
}

}  // namespace flexarm::effects
