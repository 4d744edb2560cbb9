#include "compare/standard_models.hpp"

#include "response/formulation_maker.hpp"
#include "response/settings.hpp"

#include <string_view>

namespace flexarm::compare {

namespace {

Model model(std::string_view name, std::string settings, int roots) {
  return {std::string(name), std::move(settings), [name, roots](const arm::Arm& arm) {
            return response::make_formulation(name, arm, roots);
          }};
}

}  // namespace

std::vector<Model> standard_models(int roots) {
  return {
      model(exact_tf::ExactArm::kName, "", roots),
      model(fem::FemArm::kName, response::describe(response::fem_settings(roots)), roots),
      model(assumed_modes::AssumedModesArm::kName,
            response::describe(response::assumed_modes_settings(roots)), roots),
  };
}

}  // namespace flexarm::compare
