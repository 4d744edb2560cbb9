// Crossings inside a step: none is missed, none is made up.
#include "response/time/first_crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace flexarm::response {
namespace {

/// prod (r - root), by ascending powers, times `factor`.
std::vector<double> with_roots(const std::vector<double>& roots, double factor) {
  std::vector<double> series = {factor};
  for (const double root : roots) {
    series.insert(series.begin(), 0.0);
    for (std::size_t k = 0; k + 1 < series.size(); ++k) series[k] -= root * series[k + 1];
  }
  return series;
}

TEST(FirstCrossing, FindsASimpleRootToRounding) {
  const std::array series = {0.3, -1.0};
  ASSERT_TRUE(first_crossing(series).has_value());
  EXPECT_NEAR(*first_crossing(series), 0.3, 1e-16);
}

TEST(FirstCrossing, FindsTheFirstOfTwoBetweenPositiveEnds) {
  for (const double gap : {1e-1, 1e-3, 1e-5, 1e-6}) {
    const double middle = 0.37251;
    const auto found = first_crossing(with_roots({middle - gap, middle + gap}, 1.0));
    ASSERT_TRUE(found.has_value()) << gap;
    // p is known to epsilon middle^2; over the slope 2 gap.
    EXPECT_NEAR(*found, middle - gap, 1e-16 / gap);
  }
}

TEST(FirstCrossing, ATouchFromAboveIsNone) {
  const double middle = 0.37251;
  for (const double height : {1e-3, 1e-9, 1e-15}) {
    auto series = with_roots({middle, middle}, 1.0);
    series[0] += height;
    EXPECT_FALSE(first_crossing(series).has_value()) << height;
  }
}

TEST(FirstCrossing, StartsBelowZeroOrNotAtAll) {
  EXPECT_EQ(first_crossing(std::array{-1e-300, 1.0}), 0.0);
  EXPECT_FALSE(first_crossing(std::array{0.0, 1.0}).has_value());
  EXPECT_FALSE(first_crossing(std::array{0.0, 0.0}).has_value());
  EXPECT_FALSE(first_crossing(std::vector<double>{}).has_value());
  const auto falling = first_crossing(std::array{0.0, -1.0});
  ASSERT_TRUE(falling.has_value());
  EXPECT_LT(*falling, 1e-11);
}

TEST(FirstCrossing, AgreesWithTheRootsItWasMadeFrom) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.5, 1.5);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> roots;
    for (int k = 0; k < 6; ++k) roots.push_back(place(random));
    std::sort(roots.begin(), roots.end());
    double separation = 1.0;
    for (std::size_t k = 1; k < roots.size(); ++k) {
      separation = std::min(separation, roots[k] - roots[k - 1]);
    }
    if (separation < 1e-2) continue;
    auto series = with_roots(roots, 1.0);
    if (series[0] < 0.0) {
      for (double& c : series) c = -c;
    }
    const auto first = std::lower_bound(roots.begin(), roots.end(), 0.0);
    const auto found = first_crossing(series);
    if (first == roots.end() || *first > 1.0) {
      EXPECT_FALSE(found.has_value());
    } else {
      ASSERT_TRUE(found.has_value());
      EXPECT_NEAR(*found, *first, 1e-7);  // epsilon over a slope of 1e-9 at worst
    }
  }
}

TEST(FirstCrossing, OfNumbersTooLargeIsNone) {
  // Of a simulation that diverges: each half of an interval is as unbounded as the whole.
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(first_crossing(std::vector{1.0, kInfinity, -kInfinity, 0.0}));
  EXPECT_FALSE(first_crossing(std::vector{1.0, 0.0, 0.0, kLargest, -kLargest}));
}

}  // namespace
}  // namespace flexarm::response
