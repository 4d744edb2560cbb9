#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry torque_gain() {
  return {.definition = define({.name = "torque_gain",
                                .meaning = "T = factor tau",
                                .parameters = {{.name = "factor",
                                                .unit = "1",
                                                .range = arm::kAnyFinite,
                                                .meaning = "gain",
                                                .example = 1.2,
                                                .neutral = 1.0}},
                                .torque_path =
                                    [](const arm::Effect& effect) {
                                      return arm::TorqueStage{
                                          arm::torque_order::kGain,
                                          arm::PiecewiseLinear(effect.value("factor"))};
                                    }}),
          .shows = Shows::in_time_and_frequency,
          .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
            return {{.name = "factor", .lowest = 0.2, .highest = 5.0, .neutral = 1.0}};
          },
          .prior = Likely::common,
          .usual_deviation = 0.1,
          .family = Family::torque_scale,
          .speaks_for = "all sensors scaled by the same ratio; poles and zeros unchanged",
          .refuted_by = "shifted poles or zeros"};
}

}  // namespace flexarm::effects
