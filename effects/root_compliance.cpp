#include "effects/registry/entry.hpp"

#include <limits>

namespace flexarm::effects {

Entry root_compliance() {
  return {.definition = define(
              {.name = "root_compliance",
               .meaning = "a rotational spring between hub and beam root",
               .parameters = {{.name = "stiffness",
                               .unit = "N m/rad",
                               .range = arm::kPositive,
                               .meaning = "of the spring",
                               .example = 30.0,
                               .neutral = std::numeric_limits<double>::infinity()}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.springs.push_back({0.0, effect.value("stiffness")});
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double bending = scales.bending_stiffness_N_m_per_rad();
            return {{"stiffness", 0.5 * bending, 1e3 * bending, Spacing::from_infinity}};
          },
          .speaks_for = "poles and hub-angle zeros move down, and strain at the root lags the hub",
          .refuted_by = "hub-angle zeros that do not move"};
}

}  // namespace flexarm::effects
