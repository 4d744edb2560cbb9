#include "diagnose/noise_floor.hpp"

#include "measured/spectra/robust.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::vector<double> normal_numbers(std::size_t count, double deviation, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  std::vector<double> made(count);
  for (double& value : made) value = normal(engine);
  return made;
}

/// A variance from 4,000 samples varies by sqrt(2/4000) = 2 %, its root by half of that; five
/// standard deviations.
constexpr double kOfAllSamples = 0.06;

TEST(WhiteNoise, OfNoiseAloneIsItsDeviation) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    EXPECT_NEAR(white_noise(normal_numbers(4000, 0.7, seed)), 0.7, 0.7 * kOfAllSamples) << seed;
  }
}

TEST(WhiteNoise, IsSeenUnderASignalTwoHundredTimesAsLarge) {
  // A swing that decays and a drift, as hub angles have; a quarter of the spectrum or less.
  auto samples = normal_numbers(4000, 0.005, 3);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double t = 2e-3 * static_cast<double>(k);
    samples[k] += std::exp(-0.3 * t) * std::sin(kTwoPi * 11.8 * t) + 0.2 * t * t;
  }
  EXPECT_NEAR(white_noise(samples), 0.005, 0.005 * 0.1);
}

TEST(WhiteNoise, OfASignalThatFillsTheSpectrumIsAnUpperBound) {
  const auto signal = normal_numbers(4000, 1.0, 5);
  const auto noise = normal_numbers(4000, 0.1, 6);
  auto both = signal;
  for (std::size_t k = 0; k < both.size(); ++k) both[k] += noise[k];
  EXPECT_GT(white_noise(both), 0.1);
}

TEST(WhiteNoise, OfAConstantIsNone) {
  EXPECT_EQ(white_noise(std::vector<double>(100, 3.0)), 0.0);
}

measured::FrequencyChannel resonance(double relative_noise, double coherence) {
  const auto re = normal_numbers(600, relative_noise, 8);
  const auto im = normal_numbers(600, relative_noise, 9);
  measured::FrequencyChannel channel{arm::Sensor{}, {}, {}, {}};
  for (std::size_t k = 0; k < re.size(); ++k) {
    const double f = 0.5 * std::pow(120.0, static_cast<double>(k) / 599.0);
    const std::complex<double> s(0.0, f);
    channel.frequency_Hz.push_back(f);
    channel.response.push_back(std::complex<double>(1.0 + re[k], im[k]) /
                               (s * s + 0.2 * s + 144.0));
    channel.coherence.push_back(coherence);
  }
  return channel;
}

TEST(RelativeScatter, IsSeenInTheCourseWhateverTheCoherenceSays) {
  // The median of 600 squares varies by 6 % or so, its root by half of that.
  constexpr double kOfMedian = 0.15;
  for (const double coherence : {std::numeric_limits<double>::quiet_NaN(), 0.9, 0.9999}) {
    for (const double scatter : relative_scatter(resonance(0.01, coherence))) {
      EXPECT_NEAR(scatter, 0.01, 0.01 * kOfMedian) << coherence;
    }
  }
}

TEST(RelativeScatter, FollowsTheCoherenceFromLineToLine) {
  auto channel = resonance(0.01, 0.99);
  channel.coherence.front() = 0.9;
  const auto scatter = relative_scatter(channel);
  EXPECT_NEAR(scatter.front() / scatter.back(), std::sqrt((0.1 / 0.9) / (0.01 / 0.99)), 1e-9);
}

}  // namespace
}  // namespace flexarm::diagnose
