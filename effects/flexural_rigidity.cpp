#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry flexural_rigidity() {
  return {
      .definition = define({.name = "flexural_rigidity",
                            .meaning = "EI is factor times the arm file's",
                            .parameters = {{.name = "factor",
                                            .unit = "1",
                                            .range = arm::kPositive,
                                            .meaning = "of EI",
                                            .example = 0.85,
                                            .neutral = 1.0}},
                            .arm_number =
                                [](const arm::Effect& effect, arm::Arm& arm) {
                                  arm::scale_flexural_rigidity(arm.beam, effect.value("factor"));
                                }}),
      .shows = Shows::in_all,
      .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
        return {{.name = "factor", .lowest = 0.4, .highest = 2.5, .neutral = 1.0}};
      },
      .speaks_for = "all poles and zeros move in one ratio; the rigid-body inertia is as expected",
      .refuted_by = "poles and zeros that move in unlike ratios"};
}

}  // namespace flexarm::effects
