#include "compare/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace flexarm::compare {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Sums over the stations, each rounded.
constexpr double kSums = kShapeStations * kEpsilon;

arm::Mode mode(const std::function<double(double)>& shape, double hub_slope = 1.0) {
  arm::Mode sampled;
  sampled.hub_slope = hub_slope;
  for (const double x : shape_stations_m(1.0)) sampled.displacement_m.push_back(shape(x));
  return sampled;
}

double half_wave(double x) {
  return std::sin(std::numbers::pi * x);
}
double whole_wave(double x) {
  return std::sin(2.0 * std::numbers::pi * x);
}

ShapeAgreement agreement(const arm::Mode& reference, const arm::Mode& model) {
  const auto rows = compare_shapes("model", {reference}, {model});
  EXPECT_EQ(rows.size(), 1U);
  return rows.at(0);
}

TEST(Shapes, StationsRunFromTheHubToTheTipAndNotBeyond) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> length_m(0.01, 10.0);
  for (int i = 0; i < 1000; ++i) {
    const double length = length_m(random);
    const auto stations = shape_stations_m(length);
    ASSERT_EQ(stations.size(), static_cast<std::size_t>(kShapeStations));
    ASSERT_EQ(stations.front(), 0.0);
    ASSERT_EQ(stations.back(), length);
  }
}

TEST(Shapes, EqualShapesAgreeExactly) {
  const auto row = agreement(mode(half_wave, 3.0), mode(half_wave, 3.0));
  EXPECT_LE(row.one_minus_mac, kSums * kSums);
  EXPECT_EQ(row.largest_error, 0.0);
  EXPECT_EQ(row.hub_slope_error, 0.0);
}

TEST(Shapes, OrthogonalShapesHaveNoAssurance) {
  EXPECT_NEAR(agreement(mode(half_wave), mode(whole_wave)).one_minus_mac, 1.0, kSums);
}

TEST(Shapes, MacSeesAPerturbationThatASubtractionFromOneWouldLose) {
  // sin^2 of the angle between a and a + d b with a and b orthogonal and as long: d^2/(1 + d^2).
  for (const double d : {1e-3, 1e-9, 1e-12}) {
    const auto row = agreement(mode(half_wave),
                               mode([d](double x) { return half_wave(x) + d * whole_wave(x); }));
    EXPECT_NEAR(row.one_minus_mac / (d * d), 1.0, d * d + kSums * kEpsilon / (d * d) + 1e-3) << d;
    EXPECT_NEAR(row.largest_error / d, 1.0, 1e-3) << d;
  }
}

TEST(Shapes, ScaleIsSeenByTheErrorAndNotByMac) {
  const auto row =
      agreement(mode(half_wave, 1.0), mode([](double x) { return 1.1 * half_wave(x); }, 1.2));
  EXPECT_LE(row.one_minus_mac, kSums * kSums);
  EXPECT_NEAR(row.largest_error, 0.1, kSums);
  EXPECT_NEAR(row.hub_slope_error, 0.2, kSums);
  EXPECT_EQ(row.hub_slope, 1.2);
}

TEST(Shapes, AShapeTurnedOverIsAnError) {
  const auto row =
      agreement(mode(half_wave, 1.0), mode([](double x) { return -half_wave(x); }, -1.0));
  EXPECT_NEAR(row.largest_error, 2.0, kSums);
  EXPECT_EQ(row.hub_slope_error, 2.0);
}

TEST(Shapes, OnlyModesThatBothHaveAreRows) {
  const auto one = mode(half_wave);
  EXPECT_EQ(compare_shapes("model", {one, one, one}, {one, one}).size(), 2U);
}

}  // namespace
}  // namespace flexarm::compare
