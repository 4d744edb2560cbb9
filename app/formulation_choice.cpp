#include "app/formulation_choice.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/settings.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flexarm::app {

namespace {

template <class T>
void refuse(const char* option, const std::optional<T>& value, const std::string& formulation) {
  if (value) {
    throw arm::InputError(fmt::format("{}: not a setting of {}", option, formulation));
  }
}

}  // namespace

ChosenFormulation FormulationChoice::make(const arm::Arm& whole, int roots) const {
  const arm::Arm arm = response::take_apart(whole).linear;
  response::require_formulation("--formulation", name);
  if (!arm::has_beam(arm)) {
    refuse("--elements", elements, "a rigid hub");
    refuse("--degree", degree, "a rigid hub");
    refuse("--basis", basis, "a rigid hub");
    refuse("--functions", functions, "a rigid hub");
    return {std::string(response::RigidHub::kName), "", response::RigidHub(arm)};
  }
  if (name == exact_tf::ExactArm::kName) {
    refuse("--elements", elements, name);
    refuse("--degree", degree, name);
    refuse("--basis", basis, name);
    refuse("--functions", functions, name);
    return {name, "", exact_tf::ExactArm(arm)};
  }
  if (roots > response::kMostRoots) {
    throw arm::out_of_range(
        "--modes", roots, "",
        fmt::format("at most {} for {}; exact_tf has no limit", response::kMostRoots, name));
  }
  if (name == fem::FemArm::kName) {
    refuse("--basis", basis, name);
    refuse("--functions", functions, name);
    auto options = response::fem_settings(roots);
    options.mesh.elements = elements.value_or(options.mesh.elements);
    options.degree = degree.value_or(options.degree);
    return {name, response::describe(options), fem::FemArm(arm, options)};
  }
  refuse("--elements", elements, name);
  refuse("--degree", degree, name);
  auto options = response::assumed_modes_settings(roots);
  if (basis) options.basis = assumed_modes::parse_basis(*basis);
  options.functions = functions.value_or(options.functions);
  return {name, response::describe(options), assumed_modes::AssumedModesArm(arm, options)};
}

void add_formulation_choice(CLI::App& parser, FormulationChoice& choice) {
  parser.add_option("--formulation", choice.name, "exact_tf, fem or assumed_modes")
      ->capture_default_str();
  parser.add_option("--elements", choice.elements, "fem: number of elements");
  parser.add_option("--degree", choice.degree, "fem: degree of the shape functions");
  parser.add_option("--basis", choice.basis,
                    "assumed_modes: legendre, clamped_free, pinned_free, clamped_with_payload");
  parser.add_option("--functions", choice.functions, "assumed_modes: number of functions");
}

}  // namespace flexarm::app
