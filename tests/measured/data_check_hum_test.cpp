#include "arm/sensor.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_hum_line.hpp"
#include "tests/measured/data_check_cases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

/// Adds a line of 50 Hz, of a share of the signal's standard deviation.
void add_hum(std::vector<double>& values, const std::vector<double>& time_s, double share) {
  add_line(values, time_s[1] - time_s[0], 50.0, share * deviation(values));
}

std::vector<std::string> channels_with_hum(const PlantedFault& run) {
  std::vector<std::string> channels;
  for (const auto& finding : check_data(run.record, run.options)) {
    if (finding.fault == Fault::hum) channels.push_back(finding.channel);
  }
  return channels;
}

// The torque leaves lines of pulses and friction in all channels, each of which explains the
// others.
class HumOfAChannel : public testing::TestWithParam<std::uint64_t> {};

TEST_P(HumOfAChannel, IsThatOfTheOneWhichNoOtherExplains) {
  const std::size_t channels = clean(GetParam()).record.channels.size();
  for (std::size_t channel = 0; channel < channels; ++channel) {
    PlantedFault run = clean(GetParam());
    auto& [sensor, values, left_out] = run.record.channels[channel];
    add_hum(values, run.record.time_s, 0.3);
    EXPECT_THAT(channels_with_hum(run), testing::ElementsAre(arm::to_string(sensor)))
        << run.description;
  }
}

// One column is by the sum of a geometric series, three are by summing over the samples.
TEST(HumBand, LinesOfAWaveAreTheirSumsOverTheSamples) {
  constexpr double kSummed = 1e-9;
  for (const std::size_t samples : {4000U, 4001U}) {
    const HumBand band(samples, 1e-3, 50.0);
    for (const double frequency_Hz : {49.9, 49.99987, 50.0, 50.0 + 1.0 / (1e-3 * 4000.0), 50.07}) {
      const BandLines summed = band.of_wave(frequency_Hz, 1);
      const BandLines made = band.of_wave(frequency_Hz, 0);
      EXPECT_LT((made - summed.col(0)).norm(), kSummed * summed.col(0).norm()) << frequency_Hz;
    }
  }
}

constexpr std::uint64_t kPulses = 39;
constexpr std::uint64_t kMultisineWithFriction = 52;
constexpr std::uint64_t kRandom = 31;

INSTANTIATE_TEST_SUITE_P(Hum, HumOfAChannel, testing::Values(kPulses, kMultisineWithFriction));

TEST(Hum, OfTheTorqueIsNotThatOfTheChannelsThatMissIt) {
  PlantedFault run = clean(kRandom);
  add_hum(run.record.torque_N_m, run.record.time_s, 0.5);
  EXPECT_THAT(channels_with_hum(run), testing::ElementsAre("torque")) << run.description;
}

}  // namespace
}  // namespace flexarm::measured
