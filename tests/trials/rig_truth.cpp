#include "tests/trials/rig_truth.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace flexarm::trials {

std::vector<std::string> RigTruth::leading() const {
  std::vector<std::pair<double, std::string>> sorted;
  for (const auto& [name, cost] : costs) sorted.emplace_back(cost, name);
  std::ranges::sort(sorted, std::greater());
  std::vector<std::string> names;
  for (const auto& [cost, name] : sorted) {
    if (names.size() < kLeadingCauses) names.push_back(name);
  }
  return names;
}

}  // namespace flexarm::trials
