#include "response/formulation_choice.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/settings.hpp"

#include <fmt/format.h>

#include <limits>

namespace flexarm::response {

namespace {

template <class T>
void refuse(const std::string& option, const std::optional<T>& value,
            const std::string& formulation) {
  if (value) {
    throw arm::InputError(fmt::format("{}: not a setting of {}", option, formulation));
  }
}

}  // namespace

int FormulationChoice::most_roots() const {
  return name == exact_tf::ExactArm::kName ? std::numeric_limits<int>::max() : kMostRoots;
}

ChosenFormulation FormulationChoice::make(const arm::Arm& whole, int roots) const {
  const arm::Arm arm = take_apart(whole).linear;
  require_formulation(spelled("formulation"), name);
  if (!arm::has_beam(arm)) {
    refuse(spelled("elements"), elements, "a rigid hub");
    refuse(spelled("degree"), degree, "a rigid hub");
    refuse(spelled("basis"), basis, "a rigid hub");
    refuse(spelled("functions"), functions, "a rigid hub");
    return {std::string(RigidHub::kName), "", RigidHub(arm)};
  }
  if (name == exact_tf::ExactArm::kName) {
    refuse(spelled("elements"), elements, name);
    refuse(spelled("degree"), degree, name);
    refuse(spelled("basis"), basis, name);
    refuse(spelled("functions"), functions, name);
    return {name, "", exact_tf::ExactArm(arm)};
  }
  if (roots > most_roots()) {
    throw arm::InputError(
        fmt::format("{}: needs {} roots; must be at most {} for {}; exact_tf has no limit",
                    spelled("modes"), roots, kMostRoots, name));
  }
  if (name == fem::FemArm::kName) {
    refuse(spelled("basis"), basis, name);
    refuse(spelled("functions"), functions, name);
    auto options = fem_settings(roots);
    options.mesh.elements = elements.value_or(options.mesh.elements);
    options.degree = degree.value_or(options.degree);
    return {name, describe(options), fem::FemArm(arm, options)};
  }
  refuse(spelled("elements"), elements, name);
  refuse(spelled("degree"), degree, name);
  auto options = assumed_modes_settings(roots);
  if (basis) options.basis = assumed_modes::parse_basis(*basis);
  options.functions = functions.value_or(options.functions);
  return {name, describe(options), assumed_modes::AssumedModesArm(arm, options)};
}

}  // namespace flexarm::response
