#include "effects/registry/entry.hpp"

namespace flexarm::effects {

Entry hub_spring() {
  return {.definition = define(
              {.name = "hub_spring",
               .meaning = "a spring from the hub to ground (a cable)",
               .parameters = {{.name = "stiffness",
                               .unit = "N m/rad",
                               .range = arm::kNotNegative,
                               .meaning = "of the spring",
                               .example = 0.6,
                               .neutral = 0.0}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.hub_spring_N_m_per_rad += effect.value("stiffness");
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double bending = scales.bending_stiffness_N_m_per_rad();
            return {{"stiffness", 1e-4 * bending, 3.0 * bending, Spacing::from_zero}};
          },
          .speaks_for = "the hub returns: the residual hub torque is a slope over the hub angle",
          .refuted_by = "a hub angle that stays where it is left"};
}

}  // namespace flexarm::effects
