#include "response/frequency/frequency_grid.hpp"

#include "arm/input_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::response {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kPowerRounding = 1e-13;  // of a power with an exponent of up to 100

TEST(FrequencyGrid, LogarithmicFrequenciesHaveOneRatioAndBothEnds) {
  const auto frequency = logarithmic_frequencies({.from_Hz = 0.5, .to_Hz = 50.0, .points = 5});
  ASSERT_EQ(frequency.size(), 5U);
  EXPECT_EQ(frequency.front(), 0.5);
  EXPECT_EQ(frequency.back(), 50.0);
  for (std::size_t i = 1; i < frequency.size(); ++i) {
    EXPECT_NEAR(frequency[i] / frequency[i - 1], std::sqrt(10.0), kPowerRounding);
  }
}

/// Peak of 1/|s^2 + 2 zeta w s + w^2| on a grid over its true value.
double peak_found(const std::vector<double>& frequency_Hz, double omega, double zeta) {
  double largest = 0.0;
  for (const double f : frequency_Hz) {
    const std::complex<double> s(0.0, kTwoPi * f);
    largest = std::max(largest, 1.0 / std::abs(s * s + 2.0 * zeta * omega * s + omega * omega));
  }
  return largest * 2.0 * zeta * omega * omega * std::sqrt(1.0 - zeta * zeta);
}

TEST(FrequencyGrid, APeakIsMissedByTheCoarseGridAndFoundByTheRefinedOne) {
  constexpr FrequencyGrid kCoarse{.from_Hz = 1.0, .to_Hz = 100.0, .points = 40};
  for (const double zeta : {0.0003, 0.003, 0.03}) {
    const double omega = kTwoPi * 11.8618;
    const std::complex<double> pole(-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta));
    // The pole's Im is zeta^2/2 of omega beside the peak, which is of width 2 zeta: |G| is then
    // lower by zeta^2/8 or so.
    EXPECT_GT(peak_found(refined_frequencies(kCoarse, std::array{pole}), omega, zeta),
              1.0 - zeta * zeta);
    if (zeta < 0.01) {
      EXPECT_LT(peak_found(logarithmic_frequencies(kCoarse), omega, zeta), 0.5);
    }
  }
}

TEST(FrequencyGrid, AnUndampedFeatureIsSurroundedAndNotHit) {
  constexpr FrequencyGrid kCoarse{.from_Hz = 1.0, .to_Hz = 100.0, .points = 40};
  const double centre = 11.8618;
  const auto frequency =
      refined_frequencies(kCoarse, std::array{std::complex<double>(0.0, kTwoPi * centre)});
  double nearest = std::numeric_limits<double>::infinity();
  for (const double f : frequency) nearest = std::min(nearest, std::abs(f / centre - 1.0));
  EXPECT_NEAR(nearest, 1e-4, 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(frequency, std::less_equal<>()));
}

TEST(FrequencyGrid, FeaturesOutsideTheGridAndOnTheRealAxisAddNothing) {
  constexpr FrequencyGrid kGrid{.from_Hz = 1.0, .to_Hz = 10.0, .points = 10};
  const std::array<std::complex<double>, 3> outside = {
      std::complex<double>(0.0, kTwoPi * 20.0), {-5.0, 0.0}, {0.0, kTwoPi * 0.5}};
  EXPECT_EQ(refined_frequencies(kGrid, outside), logarithmic_frequencies(kGrid));
}

TEST(FrequencyGrid, LimitsThatMakeNoGridAreRefused) {
  const double infinite = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [from, to] : {std::pair{0.0, 1.0},
                                 {-1.0, 1.0},
                                 {2.0, 1.0},
                                 {1.0, 1.0},
                                 {nan, 1.0},
                                 {1.0, nan},
                                 {1.0, infinite},
                                 {infinite, infinite}}) {
    EXPECT_THROW(logarithmic_frequencies({.from_Hz = from, .to_Hz = to}), arm::InputError);
  }
  EXPECT_THROW(logarithmic_frequencies({.points = 1}), arm::InputError);
  EXPECT_THROW(logarithmic_frequencies({.points = kMostFrequencies + 1}), arm::InputError);
}

TEST(FrequencyGrid, AListThatDoesNotAscendIsRefused) {
  EXPECT_NO_THROW(require_ascending(std::array{0.1, 2.0}, "f"));
  EXPECT_THROW(require_ascending({}, "f"), arm::InputError);
  for (const auto& list : {std::array{1.0, 1.0},
                           {2.0, 1.0},
                           {0.0, 1.0},
                           {-1.0, 1.0},
                           {1.0, std::numeric_limits<double>::infinity()},
                           {1.0, std::numeric_limits<double>::quiet_NaN()}}) {
    EXPECT_THROW(require_ascending(list, "f"), arm::InputError);
  }
}

}  // namespace
}  // namespace flexarm::response
