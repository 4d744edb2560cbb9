#include "measured/spectra/periodic_spectra.hpp"

#include "arm/input_error.hpp"
#include "measured/spectra/frequency_response.hpp"
#include "measured/spectra/period.hpp"
#include "tests/measured/signals.hpp"
#include "tests/measured/simulated_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace flexarm::measured {
namespace {

std::vector<double> repeated(const std::vector<double>& period, std::size_t samples) {
  std::vector<double> values(samples);
  for (std::size_t j = 0; j < samples; ++j) values[j] = period[j % period.size()];
  return values;
}

TEST(FindPeriod, OfRepeatedNoiseIsItsLengthWhateverThatIs) {
  for (const std::size_t n : {40U, 997U, 1000U, 20'000U}) {
    const auto values = repeated(white_noise(n, n), 3 * n + n / 2);
    const auto found = find_period(values);
    ASSERT_TRUE(found) << n;
    EXPECT_EQ(found->samples, n);
    EXPECT_EQ(found->periods, 3U);
    EXPECT_EQ(found->mismatch, 0.0);
  }
}

TEST(FindPeriod, OfASmoothMultisineIsTheWholePeriodNotHalf) {
  // Odd lines only: half a period later the torque is its own negative.
  const auto torque = torque_of(
      response::Multisine{.rms_N_m = 0.05, .from_Hz = 0.1, .to_Hz = 20.0, .period_s = 10.0}, 9000,
      kPeriod_s);
  const auto found = find_period(torque);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->samples, 2000U);
  EXPECT_EQ(found->periods, 4U);
}

TEST(FindPeriod, SeesThroughNoiseAndARestBefore) {
  auto values = repeated(white_noise(500, 3), 3000);
  const auto noise = white_noise(3000, 4);
  for (std::size_t j = 0; j < values.size(); ++j) values[j] += 0.05 * noise[j];
  std::fill_n(values.begin(), 800, 0.0);
  const auto found = find_period(values);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->samples, 500U);
  EXPECT_EQ(found->periods, 4U);
  EXPECT_NEAR(found->mismatch, 0.0025, 0.001);
}

TEST(FindPeriod, OfBangBangPairsIsAPair) {
  const auto torque = torque_of(response::BangBang{0.2, 0.3, 0.0, 0}, 3960, kPeriod_s);
  const auto found = find_period(torque);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->samples, 120U);
}

TEST(FindPeriod, IsNoneForTorquesThatDoNotRepeat) {
  const response::SampleGrid grid{6000, kPeriod_s};
  for (int seed = 1; seed <= 30; ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    EXPECT_FALSE(find_period(white_noise(3000, s)));
    EXPECT_FALSE(find_period(
        response::sample(response::RandomNoise{.from_Hz = 0.1, .to_Hz = 5.0, .seed = s}, grid)
            .torque_N_m));
    EXPECT_FALSE(find_period(
        response::sample(response::RandomNoise{.from_Hz = 9.0, .to_Hz = 10.0, .seed = s}, grid)
            .torque_N_m));
  }
  EXPECT_FALSE(find_period(response::sample(response::Chirp{}, grid).torque_N_m));
  EXPECT_FALSE(find_period(response::sample(response::BangBang{}, grid).torque_N_m));
  EXPECT_FALSE(find_period(response::sample(response::Step{}, grid).torque_N_m));
  EXPECT_FALSE(find_period(std::vector<double>(1000, 0.3)));
  EXPECT_FALSE(find_period(std::vector<double>(5, 0.3)));
}

TEST(FindPeriod, RefusesAPeriodThatIsNoWholeNumberOfSamples) {
  std::vector<double> values(20'000);
  for (std::size_t j = 0; j < values.size(); ++j) {
    const double turn = kTwoPi * static_cast<double>(j) / 1000.37;
    values[j] = std::sin(turn) + std::sin(3.0 * turn + 1.0);
  }
  EXPECT_FALSE(find_period(values));
}

/// An exactly periodic torque, and an arm's readings from rest.
struct Experiment {
  static constexpr std::size_t kSamples = 2000;
  SimulatedArm arm{settling_arm(), sensors_named({"hub_angle", "hub_velocity", "strain@0.05"})};
  std::vector<double> torque(std::size_t periods) const {
    return torque_of(response::Multisine{.rms_N_m = 0.05,
                                         .from_Hz = 0.1,
                                         .to_Hz = 60.0,
                                         .period_s = kSamples * kPeriod_s,
                                         .detection_group = 4},
                     periods * kSamples, kPeriod_s);
  }
};

PeriodicSpectra spectra_of(const TimeRecord& record, std::size_t period, std::size_t periods,
                           const std::vector<int>& differences) {
  std::vector<Signal> outputs;
  for (std::size_t i = 0; i < record.channels.size(); ++i) {
    outputs.push_back({record.channels[i].values, differences[i]});
  }
  return periodic_spectra({record.torque_N_m}, outputs, kPeriod_s, period, periods);
}

TEST(PeriodicSpectraTest, IsTheSampledResponseExactlyOnceTheArmHasSettled) {
  const Experiment experiment;
  // 120 s: the first flexible pole has decayed by exp(-130), the hub's friction by exp(-240).
  const auto record = experiment.arm.record(experiment.torque(16), kPeriod_s);
  const auto found = spectra_of(record, Experiment::kSamples, 4, {2, 1, 0});
  const auto driven = driven_lines(found);
  for (std::size_t i = 0; i < 3; ++i) {
    double worst = 0.0;
    for (std::size_t k = 0; k < driven.size(); ++k) {
      if (!driven[k] || k % 3 != 0) continue;
      const double f_Hz = found.frequency_Hz[k];
      const auto expected = experiment.arm.sampled_response(i, f_Hz, kPeriod_s, 1) *
                            hold_response(TorqueHold::zero, f_Hz, kPeriod_s);
      const auto ratio = found.outputs[i].amplitude[k] / found.input.amplitude[k];
      worst = std::max(worst, std::abs(ratio / expected - 1.0));
    }
    // Images beyond the 25th, some 1e-2 of a velocity at 60 Hz, are known to 1/(24 25^2) of them,
    // and count more near a zero.
    EXPECT_LT(worst, 1e-5) << i;
  }
}

TEST(PeriodicSpectraTest, TakesTheTransientOffBeforeItHasDied) {
  const Experiment experiment;
  const auto settled = experiment.arm.record(experiment.torque(16), kPeriod_s);
  const auto early = experiment.arm.record(experiment.torque(4), kPeriod_s);
  const auto exact = spectra_of(settled, Experiment::kSamples, 4, {2, 1, 0});
  const auto found = spectra_of(early, Experiment::kSamples, 4, {2, 1, 0});
  const auto driven = driven_lines(found);
  for (std::size_t i = 0; i < 3; ++i) {
    double worst = 0.0;
    double mean_only = 0.0;
    std::vector<double> values(4 * Experiment::kSamples);
    for (std::size_t j = 2; j < values.size(); ++j) {
      const auto& y = early.channels[i].values;
      values[j] = i == 0 ? y[j] - 2.0 * y[j - 1] + y[j - 2] : i == 1 ? y[j] - y[j - 1] : y[j];
    }
    for (std::size_t k = 0; k < driven.size(); ++k) {
      if (!driven[k]) continue;
      const auto expected = exact.outputs[i].amplitude[k];
      // Phases are from the first sample used, a whole number of periods apart.
      worst = std::max(worst, std::abs(found.outputs[i].amplitude[k] / expected - 1.0));
      if (k % 20 != 2) continue;
      const auto line =
          direct_line(values, 4 * (k + 1)) /
          difference_response(found.frequency_Hz[k], kPeriod_s, 2 - static_cast<int>(i));
      mean_only =
          std::max(mean_only, std::abs(line / (2.0 * Experiment::kSamples) / expected - 1.0));
    }
    // The mean over periods is off by what the transient adds; a parabola through it is not.
    EXPECT_LT(worst, 1e-4) << i;
    EXPECT_GT(mean_only, 1e-2) << i;
  }
}

TEST(PeriodicSpectraTest, StatesTheNoiseOfItsAmplitudes) {
  constexpr std::size_t kN = 100;
  const auto period = white_noise(kN, 1);
  for (const std::size_t periods : {2U, 3U, 4U, 8U}) {
    double error = 0.0;
    double stated = 0.0;
    double chance = 0.0;
    int count = 0;
    for (std::uint64_t run = 0; run < 150; ++run) {
      auto y = repeated(period, periods * kN);
      const auto noise = white_noise(y.size(), 50 + run);
      for (std::size_t j = 0; j < y.size(); ++j) y[j] += 0.3 * noise[j];
      const auto x = repeated(period, periods * kN);
      const std::array<Signal, 1> outputs = {Signal{y}};
      const auto found = periodic_spectra({x}, outputs, kPeriod_s, kN, periods);
      for (std::size_t k = 0; k < found.frequency_Hz.size(); ++k) {
        const auto off = found.outputs[0].amplitude[k] - found.input.amplitude[k];
        error += std::norm(off);
        stated += found.outputs[0].noise_std[k] * found.outputs[0].noise_std[k];
        PeriodicSignal left = found.outputs[0];
        left.amplitude[k] = off;
        chance += probability_of_chance(left, k, found.degrees_of_freedom) < 0.05;
        EXPECT_LE(found.input.noise_std[k], 1e-12);
        ++count;
      }
    }
    // 7350 values, few of them with one degree of freedom each: 4 times sqrt(2/7350).
    EXPECT_NEAR(error / stated, 1.0, 0.07) << periods;
    EXPECT_NEAR(chance / count, 0.05, 4.0 * std::sqrt(0.05 * 0.95 / count)) << periods;
  }
}

TEST(PeriodicSpectraTest, OfOnePeriodKnowsNoNoise) {
  const auto x = white_noise(64, 1);
  const std::array<Signal, 1> outputs = {Signal{x}};
  const auto found = periodic_spectra({x}, outputs, kPeriod_s, 64, 1);
  EXPECT_EQ(found.degrees_of_freedom, 0.0);
  EXPECT_TRUE(std::isnan(found.outputs[0].noise_std[3]));
  EXPECT_LT(std::abs(found.outputs[0].amplitude[3] - direct_line(x, 4) / 32.0), 1e-13);
  EXPECT_TRUE(std::isnan(probability_of_chance(found.outputs[0], 3, 0.0)));
}

TEST(UnsettledPeriods, AreThoseOfTheTransient) {
  const Experiment experiment;
  const auto record =
      experiment.arm.record(experiment.torque(10), kPeriod_s, response::TorqueHold::zero, 1e-3);
  const std::array<Signal, 1> outputs = {Signal{record.channels[2].values}};
  const auto left_out = unsettled_periods(outputs, Experiment::kSamples, 10);
  EXPECT_GE(left_out, 1U);
  EXPECT_LE(left_out, 3U);
  const auto noise = white_noise(20'000, 9);
  const std::array<Signal, 1> settled = {Signal{noise}};
  EXPECT_EQ(unsettled_periods(settled, Experiment::kSamples, 10), 0U);
}

TEST(PeriodicSpectraTest, RefusesWhatTheRecordDoesNotHold) {
  const auto x = white_noise(100, 1);
  EXPECT_THROW(periodic_spectra({x}, {}, kPeriod_s, 60, 2), arm::InputError);
  EXPECT_THROW(periodic_spectra({x}, {}, kPeriod_s, 3, 2), arm::InputError);
  EXPECT_THROW(periodic_spectra({x}, {}, kPeriod_s, 50, 0), arm::InputError);
}

}  // namespace
}  // namespace flexarm::measured
