#include "effects/registry/entry.hpp"

#include <algorithm>

namespace flexarm::effects {

Entry time_delay() {
  return {.definition = define({.name = "time_delay",
                                .meaning = "T(t) = tau(t - delay); below 0 where the torque is "
                                           "logged late",
                                .parameters = {{.name = "delay",
                                                .unit = "s",
                                                .range = arm::kAnyFinite,
                                                .meaning = "delay of the torque",
                                                .example = 0.003,
                                                .neutral = 0.0}},
                                .torque_path =
                                    [](const arm::Effect& effect) {
                                      return arm::TorqueStage{arm::torque_order::kDelay,
                                                              arm::Delay{effect.value("delay")}};
                                    }}),
          .shows = Shows::in_time_and_frequency,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            // A loop that logs the torque of its last step beside the readings of this one is a
            // sample late. Torque that is held jumps there: the range goes on beyond.
            return {{"delay", -4.0 * scales.shortest_time_s,
                     std::min(1000.0 * scales.shortest_time_s, scales.longest_lag_s()),
                     Spacing::about_zero}};
          },
          .prior = Likely::common,
          .family = Family::timing,
          .speaks_for = "phase lag proportional to frequency; poles, zeros and magnitude unchanged",
          .refuted_by = "magnitude roll-off with frequency (that is a lag)"};
}

}  // namespace flexarm::effects
