#include "compare/convergence.hpp"

#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace flexarm::compare {
namespace {

constexpr double kWanted = 1e-9;
/// A slope through exact powers: rounding of logarithms, a few hundred epsilon.
constexpr double kExactSlope = 1e-12;

using Series = std::vector<RefinementPoint>;

Series series(const std::vector<int>& settings, const std::function<double(int)>& error) {
  Series points;
  for (const int n : settings) points.push_back({n, 2 * n, error(n)});
  return points;
}

std::vector<int> doubling(int first, int last) {
  std::vector<int> settings;
  for (int n = first; n <= last; n *= 2) settings.push_back(n);
  return settings;
}

std::vector<int> stepping(int first, int last, int step) {
  std::vector<int> settings;
  for (int n = first; n <= last; n += step) settings.push_back(n);
  return settings;
}

TEST(Convergence, ReadsAnAlgebraicOrder) {
  for (const double order : {1.0, 2.0, 4.0, 8.0}) {
    const auto points = series(doubling(2, 1024), [&](int n) { return 0.1 * std::pow(n, -order); });
    const auto seen = observe_convergence(points, Decay::algebraic, kWanted);
    ASSERT_TRUE(seen.rate) << order;
    EXPECT_NEAR(*seen.rate, order, kExactSlope);
  }
}

TEST(Convergence, ReadsDecadesPerDegreeOfFreedom) {
  // Two degrees of freedom a setting.
  const auto points = series(stepping(2, 12, 1), [](int n) { return std::pow(10.0, -n); });
  const auto seen = observe_convergence(points, Decay::exponential, kWanted);
  ASSERT_TRUE(seen.rate);
  EXPECT_NEAR(*seen.rate, 0.5, kExactSlope);
  EXPECT_FALSE(seen.rounding_onset);
  ASSERT_TRUE(seen.cheapest);
  EXPECT_EQ(seen.cheapest->degrees_of_freedom, 18);
}

TEST(Convergence, FindsWhereRoundingTakesOver) {
  // n^-4 meets a floor that rises as n^2 at n = 215.
  const auto points =
      series(doubling(2, 4096), [](int n) { return std::pow(n, -4.0) + 1e-14 * std::pow(n, 2.0); });
  const auto seen = observe_convergence(points, Decay::algebraic, 1e-6);
  ASSERT_TRUE(seen.rounding_onset);
  EXPECT_EQ(seen.rounding_onset->setting, 256);
  ASSERT_TRUE(seen.rate);
  EXPECT_NEAR(*seen.rate, 4.0, 0.1);
  ASSERT_TRUE(seen.cheapest);
  EXPECT_EQ(seen.cheapest->setting, 32);
  EXPECT_FALSE(observe_convergence(points, Decay::algebraic, 1e-8).cheapest)
      << "the last settings are worse than 1e-8 again";
}

TEST(Convergence, ASlowSeriesThatStillFallsIsNotRounding) {
  // The last steps gain less than a factor 2, as n^-7 must.
  const auto points = series(stepping(4, 60, 4), [](int n) { return 40.0 * std::pow(n, -7.0); });
  const auto seen = observe_convergence(points, Decay::algebraic, kWanted);
  EXPECT_FALSE(seen.rounding_onset);
  ASSERT_TRUE(seen.rate);
  EXPECT_NEAR(*seen.rate, 7.0, kExactSlope);
}

TEST(Convergence, ASeriesThatIsExactFromTheStartIsAllRounding) {
  for (const double error : {0.0, 2e-16}) {
    const auto points = series(doubling(2, 64), [&](int) { return error; });
    const auto seen = observe_convergence(points, Decay::algebraic, kWanted);
    EXPECT_FALSE(seen.rate);
    ASSERT_TRUE(seen.rounding_onset);
    EXPECT_EQ(seen.rounding_onset->setting, 2);
    ASSERT_TRUE(seen.cheapest);
    EXPECT_EQ(seen.cheapest->setting, 2);
    EXPECT_EQ(seen.smallest_error, error);
  }
}

TEST(Convergence, ALuckyZeroOnTheFloorDoesNotHideTheFloor) {
  const std::vector<double> errors = {1e-4, 1e-7, 1e-10, 1e-13, 6e-16, 3e-16, 0.0, 5e-16};
  Series points;
  for (int i = 0; i < 8; ++i) points.push_back({i, i, errors[static_cast<std::size_t>(i)]});
  const auto seen = observe_convergence(points, Decay::exponential, kWanted);
  ASSERT_TRUE(seen.rounding_onset);
  EXPECT_EQ(seen.rounding_onset->setting, 4);
  EXPECT_NEAR(seen.rate.value(), 3.0, kExactSlope);
}

TEST(Convergence, TwoPointsGiveNoOrder) {
  const auto points = series({2, 4}, [](int n) { return 1e-3 * std::pow(n, -4.0); });
  const auto seen = observe_convergence(points, Decay::algebraic, kWanted);
  EXPECT_FALSE(seen.rate);
  EXPECT_EQ(seen.points_fitted, 2);
  EXPECT_FALSE(observe_convergence({}, Decay::algebraic, kWanted).rate);
}

TEST(Convergence, ErrorsThatDoNotFallAlongALineGiveNoOrder) {
  const std::vector<double> rising = {1e-5, 1e-4, 3e-4, 1e-3};
  const std::vector<double> erratic = {1e-3, 5e-5, 8e-4, 6e-5, 7e-4};
  for (const auto& errors : {rising, erratic}) {
    Series points;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      points.push_back({1 << i, 1 << i, errors[i]});
    }
    EXPECT_FALSE(observe_convergence(points, Decay::algebraic, kWanted).rate);
  }
}

TEST(Convergence, SettingsWithoutTheRootAreLeftOut) {
  auto points = series(doubling(2, 256), [](int n) { return 0.1 * std::pow(n, -4.0); });
  points[0].relative_error = kNaN;
  points[4].relative_error = kNaN;
  const auto seen = observe_convergence(points, Decay::algebraic, kWanted);
  EXPECT_NEAR(seen.rate.value(), 4.0, kExactSlope);
  EXPECT_EQ(seen.smallest_error, points.back().relative_error);
}

TEST(Convergence, NoSettingWithTheRootGivesNothing) {
  const auto points = series(doubling(2, 64), [](int) { return kNaN; });
  const auto seen = observe_convergence(points, Decay::algebraic, kWanted);
  EXPECT_FALSE(seen.rate);
  EXPECT_FALSE(seen.rounding_onset);
  EXPECT_FALSE(seen.cheapest);
  EXPECT_TRUE(std::isnan(seen.smallest_error));
}

TEST(Convergence, ASettingWithoutTheRootIsNotAccurate) {
  Series points = {{2, 2, 1e-12}, {4, 4, kNaN}, {8, 8, 1e-12}};
  EXPECT_EQ(observe_convergence(points, Decay::algebraic, kWanted).cheapest->setting, 8);
  points.push_back({16, 16, kNaN});
  EXPECT_FALSE(observe_convergence(points, Decay::algebraic, kWanted).cheapest);
}

TEST(Convergence, OrderFloorAndCheapestHoldForRandomSeries) {
  // Each error is off by up to a fifth, so that the slope over 4 doublings is by 0.25 at most.
  constexpr double kNoise = 0.2;
  constexpr double kSlopeNoise = 0.3;
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    const double order = std::uniform_int_distribution(1, 4)(random) * 2.0;
    const double size = std::pow(10.0, uniform(-2.0, 1.0));
    const double floor = std::pow(10.0, uniform(-15.0, -11.0));
    const double wanted = std::pow(10.0, uniform(-10.0, -3.0));
    const auto points = series(doubling(2, 8192), [&](int n) {
      return (size * std::pow(n, -order) + floor) * (1.0 + uniform(-kNoise, kNoise));
    });
    const auto seen = observe_convergence(points, Decay::algebraic, wanted);
    if (seen.rate) {
      EXPECT_NEAR(*seen.rate, order, kSlopeNoise) << seed;
    } else {
      EXPECT_LT(seen.points_fitted, kFewestPoints) << seed;
    }
    const double crossing = std::pow(size / floor, 1.0 / order);
    if (crossing < 2000.0) {
      ASSERT_TRUE(seen.rounding_onset) << seed;
      EXPECT_GE(seen.rounding_onset->setting, 0.5 * crossing) << seed;
      EXPECT_LE(seen.rounding_onset->setting, 4.0 * std::max(crossing, 2.0)) << seed;
    }
    const auto first_accurate = std::ranges::find_if(
        points, [&](const auto& point) { return point.relative_error <= wanted; });
    ASSERT_EQ(seen.cheapest.has_value(), points.back().relative_error <= wanted) << seed;
    if (seen.cheapest) {
      EXPECT_GE(seen.cheapest->setting, first_accurate->setting) << seed;
      for (const auto& point : points) {
        if (point.setting >= seen.cheapest->setting) {
          EXPECT_LE(point.relative_error, wanted) << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace flexarm::compare
