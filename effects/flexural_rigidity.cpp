#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry flexural_rigidity() {
  return {
      .definition = define({.name = "flexural_rigidity",
                            .meaning = "EI multiplied by factor",
                            .parameters = {{.name = "factor",
                                            .unit = "1",
                                            .range = arm::kPositive,
                                            .meaning = "factor of EI",
                                            .example = 0.85,
                                            .neutral = 1.0}},
                            .arm_number =
                                [](const arm::Effect& effect, arm::Arm& arm) {
                                  arm::scale_flexural_rigidity(arm.beam, effect.value("factor"));
                                }}),
      .shows = Shows::in_all,
      .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
        return {{.name = "factor", .lowest = 0.3, .highest = 3.3, .neutral = 1.0}};
      },
      .prior = Likely::common,
      .usual_deviation = 0.05,
      .family = Family::beam_stiffness,
      .speaks_for = "all poles and zeros shifted by the same ratio; rigid-body inertia unchanged",
      .refuted_by = "poles and zeros shifted by different ratios"};
}

}  // namespace flexarm::effects
