#include "effects/registry/entry.hpp"

#include <algorithm>

namespace flexarm::effects {

namespace {

/// The beam reaches every gauge that is on it; one at its tip is on a beam of any length.
double shortest_factor(const Scales& scales) {
  const double length_m = scales.arm.beam.length_m;
  double shortest = 0.6;
  for (const arm::Sensor& sensor : scales.sensors) {
    const bool is_on_beam = sensor.kind == arm::SensorKind::strain && sensor.position_m < length_m;
    if (is_on_beam) shortest = std::max(shortest, sensor.position_m / length_m);
  }
  return shortest;
}

}  // namespace

Entry beam_length() {
  return {
      .definition = define(
          {.name = "beam_length",
           .meaning =
               "beam length multiplied by factor; EI and mass per length unchanged. A strain gauge "
               "at the tip stays at the tip, others keep their distance from the root",
           .parameters = {{.name = "factor",
                           .unit = "1",
                           .range = arm::kPositive,
                           .meaning = "factor of the beam length",
                           .example = 1.05,
                           .neutral = 1.0}},
           .arm_number = [](const arm::Effect& effect,
                            arm::Arm& arm) { arm.beam.length_m *= effect.value("factor"); }}),
      .shows = Shows::in_all,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {
            {.name = "factor", .lowest = shortest_factor(scales), .highest = 1.6, .neutral = 1.0}};
      },
      .prior = Likely::common,
      .usual_deviation = 0.005,
      .family = Family::beam_stiffness,
      .speaks_for =
          "all poles and zeros shifted by the same ratio, 1/length^2; rigid-body inertia changed "
          "as length^3",
      .refuted_by = "unchanged rigid-body inertia"};
}

}  // namespace flexarm::effects
