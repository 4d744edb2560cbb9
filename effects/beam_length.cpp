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
           .meaning = "the beam is factor times as long as the arm file says, its EI and mass "
                      "per length as they are; a strain gauge at its tip stays there, another "
                      "keeps its distance from the root",
           .parameters = {{.name = "factor",
                           .unit = "1",
                           .range = arm::kPositive,
                           .meaning = "of the beam's length",
                           .example = 1.05,
                           .neutral = 1.0}},
           .arm_number = [](const arm::Effect& effect,
                            arm::Arm& arm) { arm.beam.length_m *= effect.value("factor"); }}),
      .shows = Shows::in_all,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {
            {.name = "factor", .lowest = shortest_factor(scales), .highest = 1.6, .neutral = 1.0}};
      },
      .speaks_for =
          "poles and zeros move with 1/length^2 in one ratio, and the rigid-body inertia with "
          "length^3",
      .refuted_by = "a rigid-body inertia that is as expected"};
}

}  // namespace flexarm::effects
