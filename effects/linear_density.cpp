#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry linear_density() {
  return {.definition = define({.name = "linear_density",
                                .meaning = "mass per length multiplied by factor",
                                .parameters = {{.name = "factor",
                                                .unit = "1",
                                                .range = arm::kPositive,
                                                .meaning = "factor of the mass per length",
                                                .example = 1.15,
                                                .neutral = 1.0}},
                                .arm_number =
                                    [](const arm::Effect& effect, arm::Arm& arm) {
                                      arm::scale_linear_density(arm.beam, effect.value("factor"));
                                    }}),
          .shows = Shows::in_all,
          .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
            return {{.name = "factor", .lowest = 0.3, .highest = 3.3, .neutral = 1.0}};
          },
          .prior = Likely::common,
          .usual_deviation = 0.02,
          .family = Family::beam_mass,
          .speaks_for = "lower poles and zeros, larger rigid-body inertia",
          .refuted_by = "unchanged rigid-body inertia"};
}

}  // namespace flexarm::effects
