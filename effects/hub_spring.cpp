#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry hub_spring() {
  return {.definition = define(
              {.name = "hub_spring",
               .meaning = "spring from hub to ground, e.g. a cable",
               .parameters = {{.name = "stiffness",
                               .unit = "N m/rad",
                               .range = arm::kNotNegative,
                               .meaning = "rotational stiffness",
                               .example = 0.6,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.hub_spring_N_m_per_rad += effect.value("stiffness");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double bending = scales.bending_stiffness_N_m_per_rad();
            return {{"stiffness", 1e-4 * bending, 10.0 * bending, Spacing::from_zero}};
          },
          .family = Family::hub_spring,
          .speaks_for =
              "the hub returns to its initial angle; residual hub torque proportional to hub angle",
          .refuted_by = "a hub that does not return"};
}

}  // namespace flexarm::effects
