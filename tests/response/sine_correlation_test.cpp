#include "response/time/sine_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;

/// Rounding of a sum of 256 terms whose largest is 1e3, the drift.
constexpr double kSumRounding = 1e-11;

TEST(SineCorrelation, TakesOutAnOffsetARampAndAParabola) {
  const SineCorrelation correlation(64, 4);
  std::vector<double> samples;
  for (int k = 0; k < 256; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 64.0;
    samples.push_back(0.3 * std::sin(angle) - 0.7 * std::cos(angle) + 50.0 - 2.0 * k +
                      0.01 * k * k);
  }
  const auto part = correlation.of(samples);
  EXPECT_LT(std::abs(part.whole - Complex(0.3, -0.7)), kSumRounding);
  ASSERT_EQ(part.cycles.size(), 4U);
  for (const auto& cycle : part.cycles)
    EXPECT_LT(std::abs(cycle - Complex(0.3, -0.7)), kSumRounding);
}

TEST(SineCorrelation, HarmonicsBelongToTheSineOnlyWhereSamplingFoldsThemOntoIt) {
  const SineCorrelation correlation(16, 3);
  for (int harmonic = 2; harmonic <= 17; ++harmonic) {
    std::vector<double> samples;
    for (int k = 0; k < 48; ++k) {
      samples.push_back(std::cos(2.0 * std::numbers::pi * harmonic * k / 16.0));
    }
    const bool folds = harmonic == 15 || harmonic == 17;
    EXPECT_NEAR(std::abs(correlation.of(samples).whole), folds ? 1.0 : 0.0, kSumRounding)
        << harmonic;
  }
}

TEST(Coherence, IsOneOfCyclesThatRepeatAndUnknownOfNone) {
  EXPECT_EQ(coherence_of(std::vector<Complex>{{1.0, 2.0}, {1.0, 2.0}}), 1.0);
  EXPECT_NEAR(coherence_of(std::vector<Complex>{{1.5, 0.0}, {0.5, 0.0}}), 1.0 / 1.25, 1e-15);
  EXPECT_TRUE(std::isnan(coherence_of(std::vector<Complex>{0.0, 0.0})));
}

}  // namespace
}  // namespace flexarm::response
