#include "response/time/sensor_imperfections.hpp"

#include "arm/input_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace flexarm::response {
namespace {

std::vector<double> wave(std::size_t samples) {
  std::vector<double> signal(samples);
  for (std::size_t k = 0; k < samples; ++k)
    signal[k] = 3.0 + std::sin(0.01 * static_cast<double>(k));
  return signal;
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(SensorImperfections, NoneLeaveTheSignalAsItIs) {
  auto signal = wave(100);
  RandomNumbers random(1);
  impair(signal, {}, random);
  EXPECT_EQ(signal, wave(100));
}

TEST(SensorImperfections, NoiseIsRelativeToTheDeviationOrAbsolute) {
  constexpr std::size_t kSamples = 200'000;
  const auto clean = wave(kSamples);
  // The standard error of a standard deviation is 1/sqrt(2 n) of it; four of those.
  constexpr double kTolerance = 4.0 / 632.0;
  for (const SensorImperfections& imperfections :
       {SensorImperfections{0.01, 0.0, 0.0}, SensorImperfections{0.0, 0.2, 0.0},
        SensorImperfections{0.3, 0.2, 0.0}}) {
    auto noisy = clean;
    RandomNumbers random(4);
    impair(noisy, imperfections, random);
    const double expected = noise_deviation(clean, imperfections);
    EXPECT_NEAR(rms_difference(noisy, clean), expected, kTolerance * expected);
  }
  // The deviation of a sine is 1/sqrt(2), that of its mean is nothing.
  EXPECT_NEAR(noise_deviation(clean, {0.01, 0.0, 0.0}), 0.01 / std::sqrt(2.0), 1e-5);
}

TEST(SensorImperfections, ReadingsAreWholeMultiplesOfTheStep) {
  auto signal = wave(1000);
  RandomNumbers random(1);
  impair(signal, {0.0, 0.01, 0.125}, random);
  for (const double value : signal) EXPECT_EQ(value * 8.0, std::round(value * 8.0));
  EXPECT_LT(rms_difference(signal, wave(1000)), 0.125 / std::sqrt(12.0) * 1.2);
}

TEST(SensorImperfections, ASignalThatStandsStillHasNoRelativeNoise) {
  std::vector<double> still(100, 2.0);
  RandomNumbers random(1);
  impair(still, {0.1, 0.0, 0.0}, random);
  EXPECT_EQ(still, std::vector<double>(100, 2.0));
}

TEST(SensorImperfections, NegativeNumbersAreRefused) {
  auto signal = wave(10);
  RandomNumbers random(1);
  EXPECT_THROW(impair(signal, {-0.1, 0.0, 0.0}, random), arm::InputError);
  EXPECT_THROW(impair(signal, {0.0, std::numeric_limits<double>::infinity(), 0.0}, random),
               arm::InputError);
  EXPECT_THROW(impair(signal, {0.0, 0.0, -1.0}, random), arm::InputError);
}

TEST(RandomNumbers, TheirBitsAreThoseOfTheStandardGenerator) {
  // seed_seq and mt19937_64 are given by the standard to the bit.
  RandomNumbers random(1);
  std::seed_seq words{1U, 0U, 0U};
  std::mt19937_64 generator(words);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(random.uniform(), (static_cast<double>(generator() >> 11U) + 0.5) * 0x1p-53);
  }
}

TEST(RandomNumbers, StreamsAndSeedsDiffer) {
  EXPECT_NE(RandomNumbers(1, 0).uniform(), RandomNumbers(1, 1).uniform());
  EXPECT_NE(RandomNumbers(1).uniform(), RandomNumbers(2).uniform());
  EXPECT_NE(RandomNumbers(1).uniform(), RandomNumbers((std::uint64_t{1} << 32U) + 1).uniform());
}

TEST(RandomNumbers, WholeNumbersReachAllAndNoneBeyond) {
  RandomNumbers random(3);
  std::vector<int> counts(5, 0);
  for (int i = 0; i < 5000; ++i) ++counts.at(random.below(5));
  for (const int count : counts) EXPECT_NEAR(count, 1000, 4 * std::sqrt(1000 * 0.8));
}

}  // namespace
}  // namespace flexarm::response
