#include "assumed_modes/basis.hpp"

#include "arm/input_error.hpp"
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

/// The first effect of the arm that beam shapes cannot follow, or null.
const char* unrepresentable_effect(Basis basis, const arm::Arm& arm) {
  if (basis == Basis::legendre) return nullptr;
  for (const char* effect :
       {"root_compliance", "local_stiffness_loss", "shear_and_rotary_inertia"}) {
    if (arm.effects.contains(effect)) return effect;
  }
  return nullptr;
}

}  // namespace

void require_representable(Basis basis, const arm::Arm& arm) {
  if (const char* effect = unrepresentable_effect(basis, arm)) {
    throw arm::InputError(
        fmt::format("effects.{}: basis {} cannot represent this effect; --basis legendre can",
                    effect, to_string(basis)),
        fmt::format("effects.{}", effect));
  }
}

bool can_represent(Basis basis, const arm::Arm& arm) {
  return unrepresentable_effect(basis, arm) == nullptr;
}

}  // namespace flexarm::assumed_modes
