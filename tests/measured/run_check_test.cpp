#include "measured/checks/run_check.hpp"

#include "tests/measured/run_check_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>

namespace flexarm::measured {
namespace {

constexpr int kMeasurements = 8;

std::vector<CheckedRun> checked(const RecordedRuns& recorded) {
  std::vector<CheckedRun> runs;
  for (const auto& run : recorded.runs) runs.push_back(run.as_checked());
  return runs;
}

std::string report(const RecordedRuns& recorded, const std::vector<RunFinding>& findings) {
  std::string text = fmt::format("run {} carries {} kg, {} is noisier\n", recorded.run + 1,
                                 recorded.mass_kg, recorded.channel);
  for (const auto& run : recorded.runs) {
    text += fmt::format("  states {} kg: {}\n", run.payload.mass_kg, run.description);
  }
  for (const auto& [run, finding] : findings) {
    text += fmt::format("    run {}: {}: {}\n", run + 1, to_string(finding.fault), finding.text);
  }
  return text;
}

/// The payload to a fifth or to a tenth of the beam's mass.
bool is_payload(const RecordedRuns& recorded, const DataFinding& finding) {
  constexpr double kShare = 0.2;
  constexpr double kOfBeam = 0.1;
  return std::abs(finding.value - recorded.mass_kg) <=
         std::max(kShare * recorded.mass_kg, kOfBeam * recorded.arms.beam_mass_kg);
}

bool is_noisy_channel(const RecordedRuns& recorded, const DataFinding& finding) {
  return finding.channel == recorded.channel;
}

/// What is planted in one of several runs.
struct Plant {
  Fault fault;
  RecordedRuns (*draw)(std::uint64_t seed, bool odd);
  bool (*is_it)(const RecordedRuns&, const DataFinding&);

  std::vector<RunFinding> found(const RecordedRuns& recorded) const {
    auto findings = check_runs(checked(recorded), recorded.arms);
    std::erase_if(findings, [&](const RunFinding& one) { return one.finding.fault != fault; });
    return findings;
  }
  /// Whether the odd run alone is named.
  bool is_named(const RecordedRuns& recorded, const std::vector<RunFinding>& findings) const {
    return findings.size() == 1 && findings.front().run == recorded.run &&
           is_it(recorded, findings.front().finding);
  }
};

void PrintTo(const Plant& plant, std::ostream* out) {
  *out << to_string(plant.fault);
}

constexpr Plant kPlants[] = {{Fault::wrong_payload, plant_wrong_payload, is_payload},
                             {Fault::uneven_noise, plant_uneven_noise, is_noisy_channel}};

class RunCheck : public testing::TestWithParam<Plant> {};

TEST_P(RunCheck, NamesTheRunThatDiffers) {
  for (int i = 0; i < kMeasurements; ++i) {
    const auto recorded = GetParam().draw(static_cast<std::uint64_t>(i), true);
    const auto findings = GetParam().found(recorded);
    EXPECT_TRUE(GetParam().is_named(recorded, findings)) << report(recorded, findings);
  }
}

TEST_P(RunCheck, ClaimsNothingOfRunsThatAgree) {
  for (int i = 0; i < kMeasurements; ++i) {
    const auto recorded = GetParam().draw(static_cast<std::uint64_t>(i), false);
    const auto findings = GetParam().found(recorded);
    EXPECT_TRUE(findings.empty()) << report(recorded, findings);
  }
}

TEST(RunCheckPayload, IsNotFoundAfterTheDeadline) {
  const auto recorded = plant_wrong_payload(0, true);
  const auto of_payload = [&](const arm::Deadline& deadline) {
    return std::ranges::count(check_runs(checked(recorded), recorded.arms, deadline),
                              Fault::wrong_payload,
                              [](const RunFinding& one) { return one.finding.fault; });
  };
  EXPECT_EQ(of_payload({}), 1);
  EXPECT_EQ(of_payload(std::chrono::steady_clock::now()), 0);
}

INSTANTIATE_TEST_SUITE_P(, RunCheck, testing::ValuesIn(kPlants),
                         [](const auto& entry) { return check_name(entry.param.fault); });

/// Prints the rates of docs/measured-data.md, as DataCheckRates: found, claimed of sound ones.
TEST(RunCheckRates, DISABLED_OfManyMeasurements) {
  const int files = setting("FILES", 300);
  const int first = setting("FIRST", 1000);
  const bool verbose = setting("VERBOSE", 0) != 0;
  for (const Plant& plant : kPlants) {
    int claimed = 0;
    int named = 0;
    for (int i = first; i < first + files; ++i) {
      const auto sound = plant.draw(static_cast<std::uint64_t>(i), false);
      const auto none = plant.found(sound);
      if (!none.empty()) ++claimed;
      if (!none.empty() && verbose) fmt::print("  CLAIM {}", report(sound, none));
      const auto recorded = plant.draw(static_cast<std::uint64_t>(i), true);
      const auto findings = plant.found(recorded);
      if (plant.is_named(recorded, findings)) {
        ++named;
      } else if (verbose) {
        fmt::print("  MISS {}", report(recorded, findings));
      }
    }
    fmt::print("| {} | {} | {} | {} |\n", to_string(plant.fault), files, named, claimed);
  }
}

}  // namespace
}  // namespace flexarm::measured
