#include "exact_tf/sensor_zeros.hpp"

#include "arm/input_error.hpp"
#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"
#include "tests/reference/reference_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::exact_tf {
namespace {

/// s is lambda^2 in long double, rounded once.
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();

void expect_complete(const arm::ZeroSet& set, int count) {
  EXPECT_EQ(std::ssize(set.s_rad_per_s), count);
  EXPECT_EQ(set.count.found, count);
  EXPECT_EQ(set.count.expected, count);
  EXPECT_EQ(set.infinite, 0);
  EXPECT_TRUE(set.rejected.empty());
  EXPECT_TRUE(set.summary.converged);
  EXPECT_GT(set.summary.iterations, 0);
  EXPECT_TRUE(
      std::is_sorted(set.s_rad_per_s.begin(), set.s_rad_per_s.end(),
                     [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); }));
  for (const auto& s : set.s_rad_per_s) {
    EXPECT_GE(s.real(), 0.0);
    EXPECT_GE(s.imag(), 0.0);
    EXPECT_NE(s, 0.0);
  }
}

std::vector<double> real_ones(const arm::ZeroSet& set) {
  std::vector<double> values;
  for (const auto& s : set.s_rad_per_s) {
    if (s.imag() == 0.0) values.push_back(s.real());
  }
  return values;
}

TEST(SensorZeros, OfTheTipAgreeWithTheReferenceInAllCases) {
  ASSERT_EQ(reference::reference_cases().size(), 7u);
  for (const auto& each : reference::reference_cases()) {
    const auto& expected = each.real_tip_zero_rad_per_s;
    // One imaginary pair comes among the real ones of the list with payload inertia.
    const int count = static_cast<int>(expected.size()) + 1;
    const auto set = ExactArm(arm_of(each)).zeros(kTip, count);
    expect_complete(set, count);
    const auto real = real_ones(set);
    ASSERT_GE(real.size(), expected.size()) << each.name;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(real[i], expected[i], kRelativeTolerance * expected[i])
          << each.name << ", zero " << i + 1;
    }
  }
}

TEST(SensorZeros, OfTheTipDoNotDependOnHubInertiaOrPayloadMass) {
  for (const double inertia : {0.0, 0.02, 10.0}) {
    const auto expected = ExactArm(unit_arm(0.0, 0.0, inertia)).zeros(kTip, 12);
    for (const double hub_inertia : {0.1, 1e3}) {
      for (const double mass : {0.5, 1e2}) {
        const ExactArm exact(unit_arm(hub_inertia, mass, inertia));
        EXPECT_EQ(exact.zeros(kTip, 12).s_rad_per_s, expected.s_rad_per_s);
        EXPECT_EQ(exact.zeros({arm::SensorKind::tip_displacement}, 12).s_rad_per_s,
                  expected.s_rad_per_s);
      }
    }
  }
}

TEST(SensorZeros, OfTheTipHaveOneImaginaryPairPerPayloadInertia) {
  for (const double inertia : {1e-3, 1e-5}) {
    const double lambda = std::cbrt(1.0 / inertia);
    const int count = 5 + static_cast<int>(lambda / 4.0);
    const auto set = ExactArm(unit_arm(0.0, 0.0, inertia)).zeros(kTip, count);
    expect_complete(set, count);
    ASSERT_EQ(std::ssize(real_ones(set)), count - 1);
    const auto imaginary = *std::find_if(set.s_rad_per_s.begin(), set.s_rad_per_s.end(),
                                         [](const auto& s) { return s.real() == 0.0; });
    // J b^3 (cosh b - cos b) = sinh b + sin b: b^3 = 1/J but for terms of e^-b.
    EXPECT_NEAR(std::sqrt(imaginary.imag()), lambda,
                10.0 * std::exp(-lambda) * lambda + kRounding * lambda);
  }
}

TEST(SensorZeros, OfStrainAtTheRootAreThePolesWithoutHubInertia) {
  constexpr int kCount = 30;
  for (const auto& payload : {arm::Payload{0.0, 0.0}, arm::Payload{0.5, 0.02}}) {
    const ExactArm exact(unit_arm(0.3, payload.mass_kg, payload.inertia_kg_m2));
    const auto set = exact.zeros({arm::SensorKind::strain, 0.0}, kCount);
    expect_complete(set, kCount);
    const auto poles =
        ExactArm(unit_arm(0.0, payload.mass_kg, payload.inertia_kg_m2)).poles(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      EXPECT_EQ(set.s_rad_per_s[i].real(), 0.0);
      EXPECT_NEAR(set.s_rad_per_s[i].imag(), poles.omega_rad_per_s[i],
                  kRounding * poles.omega_rad_per_s[i]);
    }
  }
}

TEST(SensorZeros, OfStrainTendToThoseOfTheTipAsTheSensorDoes) {
  // y''(X) = z y(l) (l - X)^2/2 + ... without payload inertia; the next term is of relative order
  // l - X.
  constexpr double kDistance = 1e-9;
  const ExactArm exact(unit_arm(0.1, 0.0, 0.0));
  const auto near = exact.zeros({arm::SensorKind::strain, 1.0 - kDistance}, 5);
  const auto tip = exact.zeros(kTip, 5);
  expect_complete(near, 5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(near.s_rad_per_s[i].real(), tip.s_rad_per_s[i].real(),
                1e2 * kDistance * tip.s_rad_per_s[i].real());
  }
}

class ZerosOfSensors : public testing::TestWithParam<arm::Arm> {};

TEST_P(ZerosOfSensors, AreCompleteAndMakeTheTransferFunctionVanish) {
  constexpr int kCount = 12;
  const ExactArm exact(GetParam());
  const double l = exact.arm().beam.length_m;
  for (const arm::Sensor& sensor :
       {kTip, arm::Sensor{arm::SensorKind::tip_displacement},
        arm::Sensor{arm::SensorKind::tip_deflection}, arm::Sensor{arm::SensorKind::strain, 0.0},
        arm::Sensor{arm::SensorKind::strain, 0.05 * l},
        arm::Sensor{arm::SensorKind::strain, 0.5 * l},
        arm::Sensor{arm::SensorKind::strain, 0.95 * l}}) {
    const auto set = exact.zeros(sensor, kCount);
    expect_complete(set, kCount);
    for (const auto& s : set.s_rad_per_s) {
      // H changes sign here: a rounding of s by 1e-16 is 1e-13 of a step of 1e-3.
      const double step = 1e-3;
      const auto below = exact.transfer_function(sensor, s * (1.0 - step));
      const auto above = exact.transfer_function(sensor, s * (1.0 + step));
      const double scale = std::max(std::abs(below), std::abs(above));
      EXPECT_LE(std::abs(exact.transfer_function(sensor, s)), 1e-10 * scale)
          << to_string(sensor) << " at s = " << s;
    }
  }
}

// Arms whose poles keep away from their zeros; certificate_test.cpp judges the extremes.
INSTANTIATE_TEST_SUITE_P(Arms, ZerosOfSensors,
                         testing::Values(arm::paper_arm(), unit_arm(0.1, 0.5, 0.02),
                                         unit_arm(1.0, 0.0, 0.0), unit_arm(0.3, 2.0, 0.0)));

TEST(SensorZeros, OfStrainAtTheTipNeedPayloadInertia) {
  const arm::Sensor at_tip{arm::SensorKind::strain, 1.0};
  EXPECT_THROW(ExactArm(unit_arm(0.1, 0.5, 0.0)).zeros(at_tip, 3), arm::InputError);
  expect_complete(ExactArm(unit_arm(0.1, 0.5, 0.01)).zeros(at_tip, 3), 3);
}

TEST(SensorZeros, RefuseWhatCannotBeAsked) {
  const ExactArm exact(arm::paper_arm());
  EXPECT_THROW(exact.zeros(kTip, 0), arm::InputError);
  EXPECT_THROW(exact.zeros({arm::SensorKind::strain, 2.0}, 3), arm::InputError);
}

}  // namespace
}  // namespace flexarm::exact_tf
