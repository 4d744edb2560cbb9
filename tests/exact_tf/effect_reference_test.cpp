#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"
#include "tests/reference/effect_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace flexarm::exact_tf {
namespace {

class EffectReference : public testing::TestWithParam<reference::EffectCase> {
 protected:
  const reference::EffectCase& expected() const { return GetParam(); }
  ExactArm exact_{GetParam().arm};

  static void expect_near(std::complex<double> found, std::complex<double> wanted,
                          const std::string& what) {
    EXPECT_LE(std::abs(found - wanted), kRelativeTolerance * std::abs(wanted))
        << what << ": " << found << " instead of " << wanted;
  }
};

TEST_P(EffectReference, PolesAndHubZerosAgree) {
  const auto poles = exact_.poles(static_cast<int>(expected().pole_rad_per_s.size()));
  const double lowest = expected().lowest_omega_squared_rad2_per_s2;
  EXPECT_NEAR(poles.lowest_omega_squared_rad2_per_s2, lowest,
              kRelativeTolerance * std::abs(lowest));
  for (std::size_t i = 0; i < expected().pole_rad_per_s.size(); ++i) {
    expect_near(poles.omega_rad_per_s[i], expected().pole_rad_per_s[i], "pole");
  }
  EXPECT_EQ(poles.count.found, poles.count.expected);
  const auto zeros = exact_.zeros({arm::SensorKind::hub_angle},
                                  static_cast<int>(expected().hub_zero_rad_per_s.size()));
  for (std::size_t i = 0; i < expected().hub_zero_rad_per_s.size(); ++i) {
    expect_near(zeros.s_rad_per_s[i], {0.0, expected().hub_zero_rad_per_s[i]}, "hub zero");
  }
  EXPECT_EQ(zeros.count.found, zeros.count.expected);
}

TEST_P(EffectReference, TipZerosAgree) {
  const auto& real = expected().real_tip_zero_rad_per_s;
  const auto& imaginary = expected().imaginary_tip_zero_rad_per_s;
  const auto set = exact_.zeros({arm::SensorKind::tip_acceleration},
                                static_cast<int>(real.size() + imaginary.size()));
  EXPECT_TRUE(set.summary.converged);
  std::size_t on_real_axis = 0;
  std::size_t on_imaginary_axis = 0;
  for (const auto& s : set.s_rad_per_s) {
    if (s.imag() == 0.0 && on_real_axis < real.size()) expect_near(s, real[on_real_axis++], "real");
    if (s.real() == 0.0 && on_imaginary_axis < imaginary.size()) {
      expect_near(s, {0.0, imaginary[on_imaginary_axis++]}, "imaginary");
    }
  }
  EXPECT_GE(on_real_axis + on_imaginary_axis, real.size());
}

TEST_P(EffectReference, ModesAgree) {
  std::vector<arm::Sensor> sensors;
  for (const auto& [name, value] : expected().mode_values.front()) {
    sensors.push_back(arm::parse_sensor(name));
  }
  const auto modes = exact_.modes(static_cast<int>(expected().mode_values.size()), sensors, {});
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const std::string name = to_string(sensors[k]);
      expect_near(modes[i].sensor_values[k], expected().mode_values[i].at(name), name);
    }
  }
}

TEST_P(EffectReference, ResponsesWithDampingAgree) {
  for (const auto& point : expected().responses) {
    for (const auto& [name, wanted] : point.values) {
      expect_near(exact_.transfer_function(arm::parse_sensor(name), point.s_rad_per_s), wanted,
                  name);
    }
  }
}

TEST_P(EffectReference, DampedPolesAgree) {
  const auto& wanted = expected().damped_pole_rad_per_s;
  if (wanted.empty()) return;
  const auto set = exact_.damped_poles(static_cast<int>(wanted.size()));
  EXPECT_TRUE(set.summary.converged);
  // The file has the root that Newton's method finds from each undamped one, in
  // thick_with_shear one of them twice: what it has must be among the pairs.
  for (const auto& root : wanted) {
    const auto nearest = *std::ranges::min_element(
        set.flexible, {}, [&](const auto& pair) { return std::abs(pair.first_rad_per_s - root); });
    expect_near(nearest.first_rad_per_s, root, "first of pair");
    expect_near(nearest.second_rad_per_s, std::conj(root), "second of pair");
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, EffectReference, testing::ValuesIn(reference::effect_cases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace flexarm::exact_tf
