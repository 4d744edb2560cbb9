#include "report/figures/thinned_series.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace flexarm::report {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr double kWidth_px = 500.0;
constexpr std::size_t kPoints = 100'000;
const Axis kLinear{};
const Axis kLogarithmic{.scale = Scale::logarithmic};
const Range kAll{0.0, static_cast<double>(kPoints)};

Series wave(std::size_t points = kPoints) {
  Series series{"wave", {}, {}, {}};
  for (std::size_t k = 0; k < points; ++k) {
    series.x.push_back(static_cast<double>(k));
    series.y.push_back(2.0 + std::sin(0.002 * static_cast<double>(k)));
  }
  return series;
}

std::size_t gap_count(const Series& series) {
  return static_cast<std::size_t>(
      std::ranges::count_if(series.y, [](double value) { return std::isnan(value); }));
}

TEST(ThinnedSeries, OfALongOneExtremesEndsAndOrderRemain) {
  Series series = wave();
  series.y[23'456] = 7.0;
  series.y[23'457] = -8.0;
  const Series shown = thinned(series, kLinear, kLinear, kAll, kWidth_px);
  EXPECT_LE(shown.x.size(), 4 * kWidth_px);
  EXPECT_EQ(std::ranges::max(shown.y), 7.0);
  EXPECT_EQ(std::ranges::min(shown.y), -8.0);
  EXPECT_TRUE(std::ranges::is_sorted(shown.x));
  EXPECT_EQ(shown.x.front(), series.x.front());
  EXPECT_EQ(shown.x.back(), series.x.back());
  EXPECT_EQ(gap_count(shown), 0U);
}

TEST(ThinnedSeries, EveryColumnOfALogarithmicAxisKeepsItsRange) {
  Series series = wave();
  series.x.front() = kGap;
  const Range range{1.0, static_cast<double>(kPoints)};
  const Series shown = thinned(series, kLogarithmic, kLogarithmic, range, kWidth_px);
  const double columns_per_decade = kWidth_px / std::log10(range.to);
  const auto extremes = [&](const Series& of) {
    std::vector<std::pair<double, double>> found(static_cast<std::size_t>(kWidth_px) + 1,
                                                 {HUGE_VAL, -HUGE_VAL});
    for (std::size_t i = 0; i < of.x.size(); ++i) {
      if (!(of.x[i] > 0.0)) continue;
      auto& [low, high] = found[static_cast<std::size_t>(columns_per_decade * std::log10(of.x[i]))];
      low = std::fmin(low, of.y[i]);
      high = std::fmax(high, of.y[i]);
    }
    return found;
  };
  EXPECT_EQ(extremes(shown), extremes(series));
}

TEST(ThinnedSeries, GapsRemainBetweenThePointsThatDo) {
  Series series = wave();
  for (std::size_t k = 40'000; k < 60'000; ++k) series.y[k] = kGap;
  for (std::size_t k = 80'000; k < 80'050; ++k) series.y[k] = kGap;  // within one column
  const Series shown = thinned(series, kLinear, kLinear, kAll, kWidth_px);
  EXPECT_EQ(gap_count(shown), 2U);
  const Series positive = thinned(series, kLinear, kLogarithmic, kAll, kWidth_px);
  EXPECT_EQ(gap_count(positive), 2U);
}

TEST(ThinnedSeries, AnAreaKeepsTheExtremesOfBothSides) {
  Series series = wave();
  series.style.filled = true;
  for (const double y : series.y) series.y_to.push_back(y + 1.0);
  series.y[5'000] = -3.0;
  series.y_to[5'001] = 9.0;
  const Series shown = thinned(series, kLinear, kLinear, kAll, kWidth_px);
  EXPECT_EQ(shown.y.size(), shown.y_to.size());
  EXPECT_LE(shown.x.size(), 6 * kWidth_px);
  EXPECT_EQ(std::ranges::min(shown.y), -3.0);
  EXPECT_EQ(std::ranges::max(shown.y_to), 9.0);
}

TEST(ThinnedSeries, MarkersHaveBroaderColumns) {
  Series series = wave();
  const std::size_t of_line = thinned(series, kLinear, kLinear, kAll, kWidth_px).x.size();
  series.style.line = Line::none;
  series.style.marker = Marker::disc;
  EXPECT_LT(thinned(series, kLinear, kLinear, kAll, kWidth_px).x.size(), of_line / 2);
}

TEST(ThinnedSeries, FewPointsAndALocusStayAsTheyAre) {
  const Series few = wave(2000);
  EXPECT_EQ(thinned(few, kLinear, kLinear, {0.0, 2000.0}, kWidth_px).y, few.y);
  EXPECT_EQ(thinned(few, kLinear, kLinear, {0.0, 1e6}, kWidth_px).y, few.y);  // in one column
  Series locus = wave();
  std::swap(locus.x[10], locus.x[20]);
  EXPECT_EQ(thinned(locus, kLinear, kLinear, kAll, kWidth_px).y.size(), kPoints);
}

TEST(ThinnedSeries, WhatLiesOutsideThePanelIsNoMoreThanAColumnASide) {
  const Series shown = thinned(wave(), kLinear, kLinear, {50'000.0, 50'100.0}, kWidth_px);
  EXPECT_LE(shown.x.size(), 101U + 8U);
  EXPECT_EQ(shown.x.front(), 0.0);
}

}  // namespace
}  // namespace flexarm::report
