#include "measured/spectra/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace flexarm::measured {
namespace {

std::vector<double> white(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise;
  std::vector<double> values(count);
  for (double& value : values) value = noise(generator);
  return values;
}

/// x_k = pole x_{k-1} + w_k.
std::vector<double> coloured(std::size_t count, double pole, unsigned seed) {
  auto values = white(count, seed);
  for (std::size_t k = 1; k < count; ++k) values[k] += pole * values[k - 1];
  return values;
}

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// sum_t e(t) u(t - lag), about the means.
double lagged_sum(const std::vector<double>& e, const std::vector<double>& u, long lag) {
  const double e_mean = mean_of(e);
  const double u_mean = mean_of(u);
  double sum = 0.0;
  for (long t = 0; t < std::ssize(e); ++t) {
    if (t - lag < 0 || t - lag >= std::ssize(u)) continue;
    sum +=
        (e[static_cast<std::size_t>(t)] - e_mean) * (u[static_cast<std::size_t>(t - lag)] - u_mean);
  }
  return sum;
}

TEST(ResidualCorrelation, IsThatOfTheDefinition) {
  const auto e = coloured(301, 0.5, 1);
  const auto u = coloured(301, 0.8, 2);
  const auto r = residual_correlation(e, u, 20);
  ASSERT_EQ(r.auto_lag.size(), 21U);
  ASSERT_EQ(r.cross_lag.size(), 41U);
  EXPECT_EQ(r.samples, 301U);
  const double ee = lagged_sum(e, e, 0);
  const double scale = std::sqrt(ee * lagged_sum(u, u, 0));
  constexpr double kRounding = 1e-12;  // a few epsilon times the terms of a transform
  for (long k = 0; k <= 20; ++k) {
    EXPECT_NEAR(r.auto_lag[static_cast<std::size_t>(k)], lagged_sum(e, e, k) / ee, kRounding);
  }
  for (long k = -20; k <= 20; ++k) {
    EXPECT_NEAR(r.cross_lag[static_cast<std::size_t>(k + 20)], lagged_sum(e, u, k) / scale,
                kRounding);
  }
  double bartlett = 0.0;
  for (long k = -300; k <= 300; ++k) {
    bartlett += lagged_sum(e, e, k) / ee * lagged_sum(u, u, k) / lagged_sum(u, u, 0);
  }
  EXPECT_NEAR(r.cross_bound, 2.5758293035489 * std::sqrt(bartlett / 301.0), 1e-10);
  EXPECT_NEAR(r.auto_bound, 2.5758293035489 / std::sqrt(301.0), kRounding);
}

TEST(ResidualCorrelation, WhiteNoiseStaysWithinItsBoundsAtNinetyNinePerCentOfTheLags) {
  std::size_t auto_beyond = 0;
  std::size_t cross_beyond = 0;
  std::size_t auto_lags = 0;
  std::size_t cross_lags = 0;
  for (unsigned trial = 0; trial < 60; ++trial) {
    // Whatever the spectrum of the input.
    const auto r =
        residual_correlation(white(4000, 100 + trial), coloured(4000, 0.95, 500 + trial), 100);
    auto_beyond += r.auto_beyond();
    cross_beyond += r.cross_beyond();
    auto_lags += r.greatest_lag;
    cross_lags += r.cross_lag.size();
  }
  // Of 6,000 lags 60 are expected beyond; their standard deviation is 7.7. Neighbouring lags of the
  // cross-correlation go together, some 1/(1 - 0.95^2) of them.
  EXPECT_NEAR(static_cast<double>(auto_beyond) / static_cast<double>(auto_lags), 0.01, 0.006);
  EXPECT_NEAR(static_cast<double>(cross_beyond) / static_cast<double>(cross_lags), 0.01, 0.01);
}

TEST(ResidualCorrelation, OfColouredNoiseExceedsTheBounds) {
  const auto r = residual_correlation(coloured(2000, 0.7, 4), {}, 25);
  EXPECT_GT(r.auto_lag[1], 10.0 * r.auto_bound);
  EXPECT_NEAR(r.auto_lag[1], 0.7, 0.05);  // two standard errors and more
  EXPECT_GE(r.auto_beyond(), 5U);
  EXPECT_TRUE(r.cross_lag.empty());
}

TEST(ResidualCorrelation, AResidualThatFollowsTheInputShowsAtItsPositiveLag) {
  const auto u = white(3000, 8);
  auto e = white(3000, 9);
  for (std::size_t k = 7; k < e.size(); ++k) e[k] += 0.3 * u[k - 7];
  const auto r = residual_correlation(e, u, 25);
  EXPECT_GT(r.cross_lag[25 + 7], 4.0 * r.cross_bound);
  EXPECT_LT(std::abs(r.cross_lag[25 - 7]), 2.0 * r.cross_bound);
}

TEST(ResidualCorrelation, GapsCountAsNoSample) {
  auto e = white(1000, 3);
  for (std::size_t k = 0; k < e.size(); k += 10) {
    e[k] = std::numeric_limits<double>::quiet_NaN();
  }
  const auto r = residual_correlation(e, {}, 25);
  EXPECT_EQ(r.samples, 900U);
  EXPECT_LE(r.auto_beyond(), 3U);
}

TEST(ResidualCorrelation, OfAConstantOrNothingIsZero) {
  const auto constant = residual_correlation(std::vector<double>(50, 2.0), {}, 5);
  for (const double value : constant.auto_lag) EXPECT_EQ(value, 0.0);
  EXPECT_TRUE(residual_correlation({}, {}, 5).auto_lag.empty());
  EXPECT_EQ(residual_correlation(white(3, 1), {}, 25).greatest_lag, 2U);
}

TEST(LjungBox, OfWhiteNoiseHasAsManyDegreesOfFreedomAsLags) {
  constexpr int kLags = 20;
  constexpr int kSeeds = 40;
  double sum = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) sum += ljung_box(white(500, seed), kLags);
  // Mean 20 and variance 40 each: within four deviations of the mean of all.
  EXPECT_NEAR(sum / kSeeds, kLags, 4.0 * std::sqrt(2.0 * kLags / kSeeds));
}

TEST(LjungBox, OfAConstantIsLargeOfZerosZeroAndOfNaNNaN) {
  EXPECT_GT(ljung_box(std::vector(100, 0.5), 20), 1000.0);
  EXPECT_EQ(ljung_box(std::vector(100, 0.0), 20), 0.0);
  std::vector<double> values = white(100, 1);
  values[50] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(ljung_box(values, 20)));
}

}  // namespace
}  // namespace flexarm::measured
