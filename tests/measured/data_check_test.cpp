#include "measured/data_check.hpp"

#include "tests/measured/data_check_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace flexarm::measured {
namespace {

constexpr Fault kFaults[] = {
    Fault::clock_jitter,     Fault::missing_samples, Fault::backward_time, Fault::saturation,
    Fault::dead_channel,     Fault::stuck_values,    Fault::quantisation,  Fault::spikes,
    Fault::drift,            Fault::swapped_channels, Fault::sign_flipped, Fault::wrong_unit,
    Fault::delay,            Fault::zero_torque};

bool is_found(const PlantedFault& planted, Fault fault, const DataFinding& finding) {
  return finding.fault == fault && finding.channel == planted.channel &&
         finding.first_sample >= planted.first_sample && finding.first_sample <= planted.last_sample;
}

int number(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

TEST(DataCheckRates, DISABLED_OfAllFaults) {
  const int files = number("FILES", 50);
  const int base = number("SEED", 1);
  const bool verbose = number("VERBOSE", 1) != 0;
  int false_claims = 0;
  for (int i = 0; i < files; ++i) {
    const auto record = clean(static_cast<std::uint64_t>(base + i));
    const auto findings = check_data(record.record, record.options);
    if (!findings.empty()) ++false_claims;
    for (const auto& finding : findings) {
      if (verbose) fmt::print("CLEAN {}\n      {}: {}\n", record.description, to_string(finding.fault), finding.text);
    }
  }
  fmt::print("clean: {} of {} with findings\n", false_claims, files);
  const int only = number("FAULT", -1);
  for (const auto fault : kFaults) {
    if (only >= 0 && static_cast<int>(fault) != only) continue;
    int found = 0;
    int further = 0;
    for (int i = 0; i < files; ++i) {
      const auto planted =
          plant(fault, static_cast<std::uint64_t>(base + 1'000'000 * (1 + static_cast<int>(fault)) + i));
      const auto findings = check_data(planted.record, planted.options);
      bool is = false;
      int more = 0;
      for (const auto& finding : findings) {
        if (is_found(planted, fault, finding)) is = true; else ++more;
      }
      if (is) ++found;
      if (more > 0) ++further;
      if (verbose && (!is || more > 0)) {
        fmt::print("{} {} {} in {} ({} to {})\n", is ? "more" : "MISS", to_string(fault), planted.description, planted.channel, planted.first_sample, planted.last_sample);
        for (const auto& finding : findings) fmt::print("     {}: {}\n", to_string(finding.fault), finding.text);
      }
    }
    fmt::print("{}: found {} of {}, further findings in {}\n", to_string(fault), found, files, further);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace flexarm::measured
