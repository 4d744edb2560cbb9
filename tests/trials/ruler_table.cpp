#include "tests/trials/ruler_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace flexarm::trials {

bool is_ruler(const TrialResult& one) {
  return one.arm == "steel ruler";
}

std::string ruler_table(const Results& ruler) {
  std::map<std::string, Results> by_effect;
  for (const TrialResult& one : ruler) {
    by_effect[fmt::format("{}, size {}, noise {:g} %", fmt::join(one.hidden, "+"), one.strength,
                          100.0 * one.noise)]
        .push_back(one);
  }
  std::string text =
      header("", {"identified, or in a class of at most three",
                  "parameters within 1.96 standard errors", "local_stiffness_loss identified"});
  for (const auto& [name, some] : by_effect) {
    const auto all = static_cast<int>(some.size());
    int covered = 0;
    int parameters = 0;
    for (const TrialResult& one : some) {
      covered += one.covered;
      parameters += one.parameters;
    }
    const int cracks = count(some, [](const TrialResult& one) {
      return std::ranges::find(one.named, "local_stiffness_loss") != one.named.end();
    });
    text +=
        row(name, {part(count(some, is_found), all), part(covered, parameters), part(cracks, all)});
  }
  return text;
}

}  // namespace flexarm::trials
