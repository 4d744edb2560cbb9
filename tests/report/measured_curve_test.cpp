#include "report/figures/measured_curve.hpp"

#include "report/figures/refined_curve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace flexarm::report {
namespace {

std::ptrdiff_t gaps(const Series& series) {
  return std::ranges::count_if(series.y, [](double value) { return std::isnan(value); });
}

/// Two stretches of frequencies, 0.01 Hz apart.
std::vector<double> two_stretches(int points) {
  std::vector<double> frequency_Hz;
  for (const double from_Hz : {10.0, 40.0}) {
    for (int k = 0; k < points; ++k) frequency_Hz.push_back(from_Hz + 0.01 * k);
  }
  return frequency_Hz;
}

TEST(MeasuredCurve, IsNotJoinedFromOneResonanceToTheNext) {
  const auto frequency_Hz = two_stretches(150);
  const std::vector<double> ones(frequency_Hz.size(), 1.0);
  const Series curve = measured_curve("m", frequency_Hz, ones);
  EXPECT_EQ(curve.style.line, Line::solid);
  EXPECT_EQ(gaps(curve), 1);
  EXPECT_EQ(gaps(measured_interval("i", frequency_Hz, ones, ones)), 1);
}

TEST(MeasuredCurve, OfLogarithmicFrequenciesHasNoGap) {
  std::vector<double> frequency_Hz;
  for (int k = 0; k < 300; ++k) frequency_Hz.push_back(std::pow(10.0, 0.01 * k));
  const std::vector<double> ones(frequency_Hz.size(), 1.0);
  EXPECT_EQ(gaps(measured_curve("m", frequency_Hz, ones)), 0);
}

TEST(MeasuredCurve, OfFewPointsIsMarkersWithBars) {
  const auto frequency_Hz = two_stretches(10);
  const std::vector<double> low(frequency_Hz.size(), 1.0);
  const std::vector<double> high(frequency_Hz.size(), 2.0);
  const Series curve = measured_curve("m", frequency_Hz, low);
  EXPECT_EQ(curve.style.line, Line::none);
  EXPECT_NE(curve.style.marker, Marker::none);
  const Series bars = measured_interval("i", frequency_Hz, low, high);
  EXPECT_FALSE(bars.style.filled);
  ASSERT_EQ(bars.y.size(), 60U);
  EXPECT_EQ(bars.x[0], bars.x[1]);
  EXPECT_EQ(bars.y[1], 2.0);
  EXPECT_TRUE(std::isnan(bars.y[2]));
}

TEST(RefinedCurve, ReachesThePeakAndTheValleyOfLightDamping) {
  constexpr double kZeta = 1e-5;
  const auto block = [](double f_Hz, double at_Hz) {
    return std::complex<double>(at_Hz * at_Hz - f_Hz * f_Hz, 2.0 * kZeta * at_Hz * f_Hz);
  };
  const auto value = [&](double f_Hz) { return block(f_Hz, 30.3) / block(f_Hz, 11.1); };
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    const auto curve = refined_curve(value, 0.1, 100.0, scale);
    EXPECT_TRUE(std::ranges::is_sorted(curve.frequency_Hz));
    EXPECT_NEAR(curve.frequency_Hz.back(), 100.0, 1e-9);
    EXPECT_LT(curve.frequency_Hz.size(), 3000U);
    double least = HUGE_VAL;
    double most = 0.0;
    for (const auto& response : curve.response) {
      least = std::min(least, std::abs(response));
      most = std::max(most, std::abs(response));
    }
    // Neighbours differ by a tenth at most, so that the extreme lies as near.
    EXPECT_GT(most, 0.9 * std::abs(value(11.1)));
    EXPECT_LT(least, 1.1 * std::abs(value(30.3)));
  }
}

}  // namespace
}  // namespace flexarm::report
