#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry hub_inertia() {
  return {.definition = define({.name = "hub_inertia",
                                .meaning = "hub inertia multiplied by factor",
                                .parameters = {{.name = "factor",
                                                .unit = "1",
                                                .range = arm::kPositive,
                                                .meaning = "factor of the hub inertia",
                                                .example = 1.4,
                                                .neutral = 1.0}},
                                .arm_number =
                                    [](const arm::Effect& effect, arm::Arm& arm) {
                                      arm.hub.inertia_kg_m2 *= effect.value("factor");
                                    }}),
          .shows = Shows::in_all,
          .search = [](const Scales& /*scales*/) -> std::vector<SearchedParameter> {
            return {{.name = "factor", .lowest = 0.2, .highest = 5.0, .neutral = 1.0}};
          },
          .prior = Likely::common,
          .usual_deviation = 0.2,
          .family = Family::hub_inertia,
          .speaks_for = "poles shifted; hub-angle zeros (the poles with the hub locked) unchanged",
          .refuted_by = "shifted hub-angle zeros"};
}

}  // namespace flexarm::effects
