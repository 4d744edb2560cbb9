#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "tests/reference/effect_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

using Complex = std::complex<double>;
using reference::EffectCase;
using testing_arms::kDefault;
using testing_arms::kRounding;

/// The fourth real zero of the tip has lost six digits of its nineteen.
constexpr double kFourthTipZero = 1e-11;
/// Values far below the largest that the same modes give elsewhere lose digits.
constexpr double kValues = 1e-12;

class EffectReference : public testing::TestWithParam<EffectCase> {
 protected:
  AssumedModesArm model() const {
    return AssumedModesArm(GetParam().arm, {Basis::legendre, kDefault});
  }
};

void expect_close(Complex actual, Complex expected, double tolerance, const std::string& what) {
  EXPECT_LE(std::abs(actual - expected), tolerance * std::abs(expected))
      << what << ": " << actual << " instead of " << expected << ", relative "
      << std::abs(actual / expected - 1.0);
}

TEST_P(EffectReference, PolesAndHubZeros) {
  const EffectCase& expected = GetParam();
  const AssumedModesArm arm = model();
  const auto poles = arm.poles(6);
  const auto zeros = arm.zeros(testing_arms::kHubAngle, 6).s_rad_per_s;
  ASSERT_EQ(expected.pole_rad_per_s.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    expect_close(poles.omega_rad_per_s[i], expected.pole_rad_per_s[i], kRounding, "pole");
    expect_close(zeros[i], {0.0, expected.hub_zero_rad_per_s[i]}, kRounding, "hub zero");
  }
  expect_close(poles.lowest_omega_squared_rad2_per_s2, expected.lowest_omega_squared_rad2_per_s2,
               kRounding, "lowest");
}

TEST_P(EffectReference, TipZeros) {
  std::vector<Complex> expected;
  for (const double s : GetParam().real_tip_zero_rad_per_s) expected.emplace_back(s, 0.0);
  for (const double s : GetParam().imaginary_tip_zero_rad_per_s) expected.emplace_back(0.0, s);
  std::ranges::sort(expected, {}, [](Complex s) { return std::abs(s); });
  const auto zeros = model().zeros(testing_arms::kTipAcceleration, 4).s_rad_per_s;
  ASSERT_EQ(zeros.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    expect_close(zeros[i], expected[i], kFourthTipZero, "tip zero");
}

TEST_P(EffectReference, ValuesOfModesAtTheSensors) {
  const auto& expected = GetParam().mode_values;
  std::vector<arm::Sensor> sensors;
  for (const auto& [name, value] : expected.front()) sensors.push_back(arm::parse_sensor(name));
  const auto modes = model().modes(static_cast<int>(expected.size()), sensors, {});
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const std::string name = arm::to_string(sensors[k]);
      expect_close(modes[i].sensor_values[k], expected[i].at(name), kValues, name);
    }
  }
}

TEST_P(EffectReference, ResponsesWithDamping) {
  const AssumedModesArm arm = model();
  for (const auto& point : GetParam().responses) {
    for (const auto& [name, expected] : point.values) {
      expect_close(arm.transfer_function(arm::parse_sensor(name), point.s_rad_per_s), expected,
                   kValues, name);
    }
  }
}

TEST_P(EffectReference, DampedPoles) {
  const auto& expected = GetParam().damped_pole_rad_per_s;
  if (expected.empty()) return;
  const auto poles = model().damped_poles(static_cast<int>(expected.size())).flexible;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    expect_close(poles[i].first_rad_per_s, expected[i], kRounding, "damped pole");
    EXPECT_EQ(poles[i].second_rad_per_s, std::conj(poles[i].first_rad_per_s));
  }
}

INSTANTIATE_TEST_SUITE_P(EveryCase, EffectReference, testing::ValuesIn(reference::effect_cases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace flexarm::assumed_modes
