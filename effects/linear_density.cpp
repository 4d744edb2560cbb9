#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry linear_density() {
  return {.definition = define({.name = "linear_density",
                                .meaning = "mass per length is factor times the arm file's",
                                .parameters = {{.name = "factor",
                                                .unit = "1",
                                                .range = arm::kPositive,
                                                .meaning = "of the mass per length",
                                                .example = 1.15,
                                                .neutral = 1.0}},
                                .arm_number =
                                    [](const arm::Effect& effect, arm::Arm& arm) {
                                      arm::scale_linear_density(arm.beam, effect.value("factor"));
                                    }}),
          .shows = Shows::in_all,
          .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
            return {{.name = "factor", .lowest = 0.4, .highest = 2.5, .neutral = 1.0}};
          },
          .speaks_for = "poles and zeros move down together, and the rigid-body inertia is larger",
          .refuted_by = "a rigid-body inertia that is as expected"};
}

}  // namespace flexarm::effects
