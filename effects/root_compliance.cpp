#include "effects/registry/entry.hpp"

#include <limits>

namespace flexarm::effects {

Entry root_compliance() {
  return {.definition = define(
              {.name = "root_compliance",
               .meaning = "rotational spring between hub and beam root",
               .parameters = {{.name = "stiffness",
                               .unit = "N m/rad",
                               .range = arm::kPositive,
                               .meaning = "rotational stiffness",
                               .example = 30.0,
                               .neutral = std::numeric_limits<double>::infinity()}},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.springs.push_back({0.0, effect.value("stiffness")});
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            const double bending = scales.bending_stiffness_N_m_per_rad();
            return {{"stiffness", 0.2 * bending, 1e3 * bending, Spacing::from_infinity}};
          },
          .speaks_for =
              "lower poles and hub-angle zeros; phase lag of root strain behind the hub angle",
          .refuted_by = "unchanged hub-angle zeros"};
}

}  // namespace flexarm::effects
