#include "exact_tf/partial_fractions.hpp"
#include "exact_tf/product_form.hpp"
#include "sample_arms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

namespace flexarm::exact_tf {
namespace {

using arm::Sensor;
using arm::SensorKind;

/// Below the first flexible pole of the arms here, off both axes.
constexpr std::complex<double> kFrequency(-0.3, 2.1);

/// The power of `order` with which a form tends to the exact transfer function at kFrequency.
template <class Form>
double fitted_power(const arm::Arm& arm, const Sensor& sensor, const std::vector<int>& orders) {
  const ExactArm exact(arm);
  const auto expected = exact.transfer_function(sensor, kFrequency);
  double mean_x = 0.0;
  double mean_y = 0.0;
  std::vector<std::pair<double, double>> points;
  for (const int order : orders) {
    const auto value = Form(exact, sensor, order)(kFrequency);
    const double error = std::abs(value - expected) / std::abs(expected);
    // Far above the rounding of the sums, so that the slope is that of the method.
    EXPECT_GT(error, 1e-14) << "order " << order;
    points.emplace_back(std::log(order), std::log(error));
    mean_x += points.back().first / static_cast<double>(orders.size());
    mean_y += points.back().second / static_cast<double>(orders.size());
  }
  double xy = 0.0;
  double xx = 0.0;
  for (const auto& [x, y] : points) {
    xy += (x - mean_x) * (y - mean_y);
    xx += (x - mean_x) * (x - mean_x);
  }
  return xy / xx;
}

/// Orders are those of the tail for many terms; at the orders fitted the next power still shows.
constexpr double kPowerTolerance = 0.2;

TEST(ProductForm, OfTheHubAngleConvergesWithPowerFourWithoutHubInertia) {
  EXPECT_NEAR(fitted_power<ProductForm>(unit_arm(0.0, 0.0, 0.0, 1e-3), {SensorKind::hub_angle},
                                        {10, 20, 40, 80}),
              -4.0, kPowerTolerance);
}

TEST(ProductForm, OfTheHubAngleConvergesWithPowerSevenWithHubInertia) {
  EXPECT_NEAR(fitted_power<ProductForm>(unit_arm(0.5, 0.0, 0.0, 1e-3), {SensorKind::hub_angle},
                                        {4, 8, 12, 16}),
              -7.0, kPowerTolerance);
}

TEST(PartialFractions, OfTheHubAngleConvergeWithPowerOneWithoutHubInertia) {
  EXPECT_NEAR(fitted_power<PartialFractions>(unit_arm(0.0, 0.0, 0.0, 1e-3), {SensorKind::hub_angle},
                                             {20, 40, 80, 160}),
              -1.0, kPowerTolerance);
}

TEST(PartialFractions, OfTheHubAngleConvergeWithPowerSevenWithHubInertia) {
  EXPECT_NEAR(fitted_power<PartialFractions>(unit_arm(0.5, 0.0, 0.0, 1e-3), {SensorKind::hub_angle},
                                             {4, 8, 12, 16}),
              -7.0, kPowerTolerance);
}

TEST(PartialFractions, OfTheTipConvergeWithPowerThreeWithoutHubInertia) {
  EXPECT_NEAR(fitted_power<PartialFractions>(unit_arm(0.0, 0.0, 0.0, 1e-3),
                                             {SensorKind::tip_acceleration}, {10, 20, 40, 80}),
              -3.0, kPowerTolerance);
}

TEST(PartialFractions, OfTheTipConvergeWithPowerSixWithHubInertia) {
  EXPECT_NEAR(fitted_power<PartialFractions>(unit_arm(0.5, 0.0, 0.0, 1e-3),
                                             {SensorKind::tip_acceleration}, {6, 12, 18, 24}),
              -6.0, kPowerTolerance);
}

TEST(SeriesForms, TendToTheExactValueWithBothDampings) {
  const ExactArm exact(unit_arm(0.3, 0.4, 0.05, 2e-3, 0.7));
  constexpr int kOrder = 200;
  // The tail of the slowest, the strain: terms phi''(X) phi'(0)/omega^2 ~ i^-4 of changing sign, at
  // most a sum of order kOrder^-3.
  constexpr double kTail = 1.0 / (kOrder * kOrder * kOrder);
  for (const Sensor& sensor : std::vector<Sensor>{{SensorKind::hub_angle},
                                                  {SensorKind::hub_velocity},
                                                  {SensorKind::tip_acceleration},
                                                  {SensorKind::tip_displacement},
                                                  {SensorKind::tip_deflection},
                                                  {SensorKind::strain, 0.3}}) {
    const PartialFractions fractions(exact, sensor, kOrder);
    for (const std::complex<double> s : {kFrequency, {0.0, 30.0}, {-3.0, 100.0}, {4.0, 0.0}}) {
      const auto expected = exact.transfer_function(sensor, s);
      EXPECT_LE(std::abs(fractions(s) - expected), kTail * std::abs(expected))
          << to_string(sensor) << " at " << s;
      if (!is_collocated(sensor)) continue;
      EXPECT_LE(std::abs(ProductForm(exact, sensor, kOrder)(s) - expected),
                kTail * std::abs(expected))
          << to_string(sensor) << " at " << s;
    }
  }
}

TEST(SeriesForms, RefuseTheDoublePoleAtRest) {
  const ExactArm exact(arm::paper_arm());
  EXPECT_THROW(ProductForm(exact, {SensorKind::hub_angle}, 2)(0.0), std::domain_error);
  EXPECT_THROW(PartialFractions(exact, {SensorKind::hub_angle}, 2)(0.0), std::domain_error);
}

}  // namespace
}  // namespace flexarm::exact_tf
