#include "effects/registry/entry.hpp"

#include <algorithm>

namespace flexarm::effects {

Entry actuator_lag() {
  return {
      .definition = define({.name = "actuator_lag",
                            .meaning = "T = tau / (1 + time_constant s)",
                            .parameters = {{.name = "time_constant",
                                            .unit = "s",
                                            .range = arm::kNotNegative,
                                            .meaning = "time constant of the lag",
                                            .example = 0.004,
                                            .neutral = 0.0}},
                            .torque_path =
                                [](const arm::Effect& effect) {
                                  return arm::TorqueStage{arm::torque_order::kLag,
                                                          arm::Lag{effect.value("time_constant")}};
                                }}),
      .shows = Shows::in_time_and_frequency,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {{"time_constant", 0.02 * scales.shortest_time_s,
                 std::min(2000.0 * scales.shortest_time_s, scales.longest_lag_s()),
                 Spacing::from_zero}};
      },
      .prior = Likely::common,
      .family = Family::timing,
      .speaks_for =
          "phase lag and attenuation increasing with frequency in all sensors; poles and zeros "
          "unchanged",
      .refuted_by =
          "phase lag proportional to frequency with unchanged magnitude (that is a time delay)"};
}

}  // namespace flexarm::effects
