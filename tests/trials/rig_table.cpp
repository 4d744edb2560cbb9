#include "tests/trials/rig_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace flexarm::trials {

namespace {

std::vector<std::string> rig_cells(const Results& rigs) {
  const auto trials = static_cast<int>(rigs.size());
  int leading_named = 0;
  int wrong_names = 0;
  std::vector<double> processor_s;
  for (const TrialResult& one : rigs) {
    leading_named += one.rig->leading_named;
    wrong_names += one.rig->wrong_names;
    processor_s.push_back(one.processor_s);
  }
  const int explained = count(
      rigs, [](const TrialResult& one) { return one.rig->error_over_floor <= kRigErrorOverFloor; });
  return {fmt::format("{}", trials),
          part(leading_named, trials * static_cast<int>(kLeadingCauses)),
          fmt::format("{:.2f}", static_cast<double>(wrong_names) / trials),
          part(explained, trials),
          fmt::format("{:.1f}", median(processor_s)),
          fmt::format("{:.1f}", std::ranges::max(processor_s))};
}

}  // namespace

std::string rig_table(const Results& rigs) {
  std::map<std::string, Results> by_arm;
  for (const TrialResult& one : rigs) by_arm[one.arm].push_back(one);
  std::string text =
      header("arm", {"trials", "leading effects identified", "wrong effects per trial",
                     fmt::format("validation NRMSE at most {:g} x floor", kRigErrorOverFloor),
                     "processor time: median [s]", "maximum [s]"});
  for (const auto& [arm, some] : by_arm) text += row(arm, rig_cells(some));
  return text + row("all", rig_cells(rigs));
}

}  // namespace flexarm::trials
