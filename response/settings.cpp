#include "response/settings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::response {

fem::FemArm::Options fem_settings(int roots) {
  fem::FemArm::Options options;
  options.degree = 15;
  options.mesh.elements = std::max(3, roots / 2 + roots % 2);
  return options;
}

assumed_modes::AssumedModesOptions assumed_modes_settings(int roots) {
  assumed_modes::AssumedModesOptions options;
  options.functions =
      std::clamp(2 * std::min(roots, kMostRoots) + 20, 40, assumed_modes::kMaximumFunctions);
  return options;
}

std::string formulation_label(std::string_view formulation, std::string_view settings) {
  return fmt::format("{}{}{}", formulation, settings.empty() ? "" : ", ", settings);
}

std::string describe(const fem::FemArm::Options& options) {
  return fmt::format("{} elements of degree {}", options.mesh.elements, options.degree);
}

std::string describe(const assumed_modes::AssumedModesOptions& options) {
  return fmt::format("{} functions, basis {}", options.functions,
                     assumed_modes::to_string(options.basis));
}

}  // namespace flexarm::response
