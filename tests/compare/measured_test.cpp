#include "compare/measured.hpp"

#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::compare {
namespace {

using measured::Feature;
using measured::ModalEntry;

const arm::Sensor kStrain{arm::SensorKind::strain, 0.25};

std::complex<double> at_Hz(double frequency_Hz) {
  return {0.0, 2.0 * std::numbers::pi * frequency_Hz};
}

/// Two models; only the first is held against measurements.
Comparison model() {
  Comparison comparison;
  const auto add = [&](std::optional<arm::Sensor> sensor, int order, std::complex<double> s) {
    comparison.roots.push_back({{sensor, 3}, order, {s, 1.5 * s}, {0.0, 0.5}});
  };
  add(std::nullopt, 1, at_Hz(12.0));
  add(std::nullopt, 2, at_Hz(32.0));
  add(kHubAngle, 1, at_Hz(3.0));
  add(kStrain, 1, at_Hz(20.0));
  add(kStrain, 2, {373.0, 0.0});
  add(kStrain, 3, at_Hz(73.0));
  return comparison;
}

ModalEntry measured_at(std::optional<arm::Sensor> sensor, Feature feature, int order,
                       std::optional<double> frequency_Hz) {
  ModalEntry entry;
  entry.sensor = sensor;
  entry.feature = feature;
  entry.order = order;
  entry.frequency_Hz = frequency_Hz;
  return entry;
}

MeasuredRow row_of(const ModalEntry& entry) {
  const auto rows = beside_model({entry}, model());
  EXPECT_EQ(rows.size(), 1U);
  return rows.at(0);
}

TEST(Measured, APoleIsTheModelsWhicheverSensorSawIt) {
  for (const auto& sensor : {std::optional<arm::Sensor>{}, std::optional{kHubAngle}}) {
    const auto row = row_of(measured_at(sensor, Feature::pole, 2, 40.0));
    EXPECT_DOUBLE_EQ(row.model_frequency_Hz.value(), 32.0);
    EXPECT_DOUBLE_EQ(row.error_percent, 25.0);
  }
}

TEST(Measured, OrdersThatAreNotStatedAreAssigned) {
  // 1.4 times the model's: by distance no pole would be the model's first.
  measured::ModalTable table = {measured_at(kHubAngle, Feature::pole, 1, 1.4 * 12.0),
                                measured_at(kHubAngle, Feature::zero, 1, 1.4 * 3.0)};
  for (auto& entry : table) entry.order.reset();
  for (const auto& row : beside_model(table, model())) {
    EXPECT_EQ(row.order, 1);
    EXPECT_NEAR(row.error_percent, 40.0, 1e-9);
  }
}

TEST(Measured, ZerosAreThoseOfTheirSensor) {
  EXPECT_DOUBLE_EQ(row_of(measured_at(kHubAngle, Feature::zero, 1, 3.0)).model_frequency_Hz.value(),
                   3.0);
  EXPECT_DOUBLE_EQ(row_of(measured_at(kHubAngle, Feature::zero, 1, 2.7)).error_percent, -10.0);
}

TEST(Measured, RealZerosAreNotCountedAmongAntiresonances) {
  EXPECT_DOUBLE_EQ(row_of(measured_at(kStrain, Feature::zero, 2, 73.0)).model_frequency_Hz.value(),
                   73.0);
  EXPECT_FALSE(row_of(measured_at(kStrain, Feature::zero, 3, 100.0)).model_frequency_Hz);
}

TEST(Measured, WhatIsNotThereHasNoError) {
  EXPECT_TRUE(std::isnan(row_of(measured_at(kHubAngle, Feature::zero, 2, 18.0)).error_percent));
  const auto unknown = row_of(measured_at(std::nullopt, Feature::pole, 1, std::nullopt));
  EXPECT_DOUBLE_EQ(unknown.model_frequency_Hz.value(), 12.0);
  EXPECT_TRUE(std::isnan(unknown.error_percent));
}

TEST(Measured, EveryModelIsOffBySoManyStandardDeviations) {
  auto entry = measured_at(std::nullopt, Feature::pole, 1, 12.3);
  entry.frequency_std_Hz = 0.1;
  const auto row = row_of(entry);
  ASSERT_EQ(row.deviations.size(), 2U);
  EXPECT_DOUBLE_EQ(row.frequencies_Hz[1].value(), 18.0);
  EXPECT_NEAR(row.deviations[0], 3.0, 1e-12);
  EXPECT_NEAR(row.deviations[1], -57.0, 1e-12);
  EXPECT_NEAR(row.combined_deviation, 3.0, 1e-12) << "the arm file states no uncertain number";
  EXPECT_FALSE(row.model_std_Hz);
  const auto without = row_of(measured_at(std::nullopt, Feature::pole, 1, 12.3));
  EXPECT_TRUE(std::isnan(without.deviations[0]));
  EXPECT_TRUE(std::isnan(without.combined_deviation));
}

TEST(Measured, AreComparedWithDampedRoots) {
  Comparison comparison = model();
  for (RootRow& row : comparison.roots) row.damped.resize(2);
  // |s| is that of the undamped root for neither.
  const std::complex<double> s = 31.0 * std::polar(2.0 * std::numbers::pi, std::acos(-0.05));
  comparison.roots[1].damped[0] = arm::PolePair{s, std::conj(s)};
  comparison.roots[2].damped[0] = arm::PolePair{-10.0, -40.0};
  auto pole = measured_at(std::nullopt, Feature::pole, 2, 31.0);
  pole.damping_ratio = 0.06;
  pole.damping_ratio_std = 0.005;
  const auto row = beside_model({pole}, comparison).at(0);
  EXPECT_NEAR(row.model_frequency_Hz.value(), 31.0, 1e-12);
  EXPECT_NEAR(row.undamped_Hz.value(), 32.0, 1e-12);
  EXPECT_NEAR(row.error_percent, 0.0, 1e-12);
  EXPECT_NEAR(row.model_damping_ratio.value(), 0.05, 1e-12);
  EXPECT_NEAR(row.damping_deviation, 2.0, 1e-12);
  // An overdamped zero: the geometric mean of both, and more than critical damping.
  auto zero = measured_at(kHubAngle, Feature::zero, 1, 3.0);
  const auto overdamped = beside_model({zero}, comparison).at(0);
  EXPECT_NEAR(overdamped.model_frequency_Hz.value(), 20.0 / (2.0 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(overdamped.model_damping_ratio.value(), 1.25, 1e-12);
  // A root that was not found with damping is none to compare with.
  EXPECT_FALSE(beside_model({measured_at(std::nullopt, Feature::pole, 1, 12.0)}, comparison)
                   .at(0)
                   .model_frequency_Hz);
}

/// Frequencies are proportional to the root of the rigidity: of 4 % they have 2 %.
TEST(Measured, UncertainNumbersOfTheArmMakeAStandardDeviation) {
  arm::Arm arm = arm::paper_arm();
  arm.relative_uncertainties = {{"beam.flexural_rigidity", 0.04}};
  Options few = quick();
  few.poles = 2;
  few.non_collocated_zeros = 1;
  few.response_points = 2;
  const Comparison comparison = compare(arm, few);
  auto pole = measured_at(std::nullopt, Feature::pole, 1, 12.0);
  pole.frequency_std_Hz = 0.1;
  const auto zero = measured_at(kHubAngle, Feature::zero, 2, 18.0);
  const auto rows = beside_model({pole, zero}, comparison);
  constexpr double kFirstOrder = 1e-4;  // sinh(0.002)/0.002 - 1 and rounding
  for (const auto& row : rows) {
    EXPECT_NEAR(row.model_std_Hz.value(), 0.02 * *row.model_frequency_Hz,
                kFirstOrder * *row.model_frequency_Hz);
  }
  EXPECT_NEAR(rows[0].combined_deviation,
              (12.0 - *rows[0].model_frequency_Hz) / std::hypot(0.1, *rows[0].model_std_Hz), 1e-12);
  EXPECT_LT(std::abs(rows[0].combined_deviation), std::abs(rows[0].deviations[0]));
}

TEST(Measured, SensorsWithZerosAreNamedOnceInTheirOrder) {
  const measured::ModalTable table = {
      measured_at(std::nullopt, Feature::pole, 1, 12.0),
      measured_at(kStrain, Feature::zero, 1, 20.0), measured_at(kHubAngle, Feature::zero, 1, 3.0),
      measured_at(kHubAngle, Feature::pole, 1, 12.0), measured_at(kStrain, Feature::zero, 2, 73.0)};
  EXPECT_EQ(sensors_with_zeros(table), (std::vector<arm::Sensor>{kStrain, kHubAngle}));
  EXPECT_TRUE(sensors_with_zeros({}).empty());
}

}  // namespace
}  // namespace flexarm::compare
