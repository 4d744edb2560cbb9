#include "arm/input_error.hpp"
#include "effects/registry/entry.hpp"
#include "effects/registry/rotational_spring.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::effects {

namespace {

bool is_at_root(const arm::Effect& effect, const arm::Arm& arm) {
  arm::LinearTerms terms;
  try {
    effect.definition->linear_term(effect, arm, terms);
  } catch (const arm::InputError&) {
    return false;  // needs a number that the arm does not give, which is said where it is computed
  }
  return std::ranges::any_of(
      terms.springs, [](const arm::RotationalSpring& one) { return one.position_m == 0.0; });
}

/// What a spring and a dashpot in series with another spring do is not a stiffness and a time.
void require_only_spring(const arm::Effect& effect, const arm::Arm& arm) {
  for (const auto& [name, other] : arm.effects) {
    if (other.definition == effect.definition || !other.definition->linear_term) continue;
    if (!is_at_root(other, arm)) continue;
    throw arm::InputError(
        fmt::format("effects.root_damping: the root has its spring already, by effects.{}; must be "
                    "the only spring at the root, its stiffness included",
                    name),
        "effects.root_damping");
  }
}

}  // namespace

Entry root_damping() {
  return {
      .definition = define(
          {.name = "root_damping",
           .meaning = "rotational spring and dashpot beside each other between hub and beam "
                      "root: moment stiffness (phi + time d phi/dt), phi the rotation between "
                      "them. Instead of `root_compliance`, not beside it",
           .parameters = {rotational_stiffness(30.0), retardation_time("the root", 2e-3)},
           .linear_term =
               [](const arm::Effect& effect, const arm::Arm& /*arm*/, arm::LinearTerms& terms) {
                 terms.springs.push_back({0.0, effect.value("stiffness"), effect.value("time")});
               },
           .require_fit = require_only_spring}),
      .shows = Shows::in_all,
      .search = [](const Scales& scales) -> std::vector<SearchedParameter> {
        return {searched_stiffness(scales), searched_retardation_time(scales)};
      },
      .contains = {"root_compliance"},
      .family = Family::root,
      .speaks_for =
          "lower poles and hub-angle zeros, with damping ratios in proportion to their shift",
      .refuted_by =
          "shifted poles without additional damping (that is root compliance), or damping "
          "without shift"};
}

}  // namespace flexarm::effects
