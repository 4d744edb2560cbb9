#include "tests/trials/calibration.hpp"

#include "tests/trials/clopper_pearson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace flexarm::trials {

namespace {

/// "80 % (52 to 96 %)".
std::string with_bounds(int events, int trials) {
  if (trials == 0) return "-";
  return fmt::format("{:.0f} % ({:.0f} to {:.0f} %)", 100.0 * events / trials,
                     100.0 * lower_bound_95(events, trials),
                     100.0 * upper_bound_95(events, trials));
}

}  // namespace

Reliability reliability(const std::vector<TrialResult>& results) {
  Reliability all;
  for (const TrialResult& one : results) {
    for (const Claim& claim : one.claims) {
      const double miss = claim.probability - (claim.right ? 1.0 : 0.0);
      all.brier += miss * miss;
      ++all.claims;
      const int bin = std::clamp(static_cast<int>(claim.probability * Reliability::kBins), 0,
                                 Reliability::kBins - 1);
      ReliabilityBin& of = all.bins[static_cast<std::size_t>(bin)];
      ++of.claims;
      of.right += claim.right ? 1 : 0;
      of.sum_of_probabilities += claim.probability;
    }
  }
  if (all.claims > 0) all.brier /= all.claims;
  return all;
}

std::string reliability_table(const std::vector<TrialResult>& results) {
  const Reliability all = reliability(results);
  if (all.claims == 0) return "No effect identified.\n";
  std::string text =
      fmt::format("Brier score {:.3f} over {} identified effects.\n\n", all.brier, all.claims);
  text +=
      "| stated probability [%] | identified effects | mean | actually present |\n"
      "| --- | ---: | ---: | ---: |\n";
  for (int i = 0; i < Reliability::kBins; ++i) {
    const ReliabilityBin& bin = all.bins[static_cast<std::size_t>(i)];
    if (bin.claims == 0) continue;
    const int width = 100 / Reliability::kBins;
    text += fmt::format("| {} to {} | {} | {:.0f} % | {} |\n", width * i, width * (i + 1),
                        bin.claims, 100.0 * bin.sum_of_probabilities / bin.claims,
                        with_bounds(bin.right, bin.claims));
  }
  return text;
}

std::string coverage_table(const std::vector<TrialResult>& results) {
  struct Counts {
    int parameters = 0;
    int covered = 0;
  };
  std::map<std::string, Counts> by_kind;
  for (const TrialResult& one : results) {
    if (one.parameters == 0) continue;
    by_kind[one.kind].parameters += one.parameters;
    by_kind[one.kind].covered += one.covered;
  }
  if (by_kind.empty()) return "No parameter of an identified effect.\n";
  std::string text = "| data | parameters | within 1.96 standard errors |\n| --- | ---: | ---: |\n";
  for (const auto& [kind, counts] : by_kind) {
    text += fmt::format("| {} | {} | {} |\n", kind, counts.parameters,
                        with_bounds(counts.covered, counts.parameters));
  }
  return text;
}

}  // namespace flexarm::trials
