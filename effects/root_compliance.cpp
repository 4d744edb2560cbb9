#include "effects/registry/entry.hpp"
#include "effects/registry/rotational_spring.hpp"

namespace flexarm::effects {

Entry root_compliance() {
  return {.definition = define(
              {.name = "root_compliance",
               .meaning = "rotational spring between hub and beam root",
               .parameters = {rotational_stiffness(30.0)},
               .linear_term =
                   [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                     terms.springs.push_back({0.0, effect.value("stiffness")});
                   }}),
          .shows = Shows::in_all,
          .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
            return {searched_stiffness(scales)};
          },
          .prior = Likely::common,
          .family = Family::root,
          .speaks_for =
              "lower poles and hub-angle zeros; phase lag of root strain behind the hub angle",
          .refuted_by = "unchanged hub-angle zeros"};
}

}  // namespace flexarm::effects
