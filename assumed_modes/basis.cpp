#include "assumed_modes/basis.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::assumed_modes {

std::string_view to_string(Basis basis) {
  switch (basis) {
    case Basis::legendre:
      return "legendre";
    case Basis::clamped_free:
      return "clamped_free";
    case Basis::pinned_free:
      return "pinned_free";
    case Basis::clamped_with_payload:
      return "clamped_with_payload";
  }
  throw std::logic_error("basis outside its enumeration");
}

Basis parse_basis(std::string_view name) {
  std::vector<std::string> names;
  for (const Basis basis : kAllBases) {
    if (to_string(basis) == name) return basis;
    names.emplace_back(to_string(basis));
  }
  throw arm::InputError(fmt::format("basis {}: unknown{}; allowed: {}", name,
                                    arm::did_you_mean(name, names), fmt::join(names, ", ")));
}

namespace {

/// The first effect of the arm that beam shapes cannot follow, by name, or null: one that breaks
/// the beam's slope or shear force, or lets its cross-sections or its hub turn by themselves.
const std::string* unrepresentable_effect(Basis basis, const arm::Arm& arm) {
  if (basis == Basis::legendre) return nullptr;
  const arm::Arm changed = arm::with_changed_numbers(arm);
  for (const auto& [name, effect] : arm.effects) {
    if (!effect.definition->linear_term) continue;
    arm::LinearTerms terms;
    effect.definition->linear_term(effect, changed, terms);
    const bool turns_by_itself = terms.drive || !terms.springs.empty() || terms.shear;
    if (turns_by_itself || !terms.masses.empty()) return &name;
  }
  return nullptr;
}

}  // namespace

void require_representable(Basis basis, const arm::Arm& arm) {
  if (const std::string* effect = unrepresentable_effect(basis, arm)) {
    throw arm::InputError(
        fmt::format("effects.{}: basis {} cannot represent this effect; --basis legendre can",
                    *effect, to_string(basis)),
        "effects." + *effect);
  }
}

bool can_represent(Basis basis, const arm::Arm& arm) {
  return unrepresentable_effect(basis, arm) == nullptr;
}

}  // namespace flexarm::assumed_modes
