#include "effect_arms.hpp"
#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::exact_tf {
namespace {

using PlainComplex = std::complex<double>;

/// Rounding in doubles, 2e-16, times e^3 for the power series of a segment, times the segments of
/// twenty modes. Values near their zeros, and dampings that are differences, lose two digits more.
constexpr double kWorkingRounding = 1e-13;
constexpr double kWorkingValues = 1e-11;
constexpr int kWorkingModes = 16;

double working_error(PlainComplex working, PlainComplex extended) {
  return std::abs(working - extended) / std::abs(extended);
}

std::vector<arm::Sensor> read_sensors() {
  return {{arm::SensorKind::hub_angle},
          {arm::SensorKind::hub_velocity},
          {arm::SensorKind::tip_acceleration},
          {arm::SensorKind::tip_deflection},
          {arm::SensorKind::strain, 0.05}};
}

/// Closed forms and transfer matrices, damped and undamped.
class InWorkingArithmetic : public testing::TestWithParam<arm::Arm> {
 protected:
  ExactArm extended_{GetParam()};
  ExactArm working_{GetParam(), Arithmetic::working};
};

TEST_P(InWorkingArithmetic, ModesAreTheSame) {
  const auto sensors = read_sensors();
  const arm::ModalModel wanted = extended_.modal_model(kWorkingModes, sensors, {});
  const arm::ModalModel found = working_.modal_model(kWorkingModes, sensors, {});
  ASSERT_EQ(found.modes.size(), wanted.modes.size());
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    double largest = 0.0;
    for (const arm::Mode& mode : wanted.modes) {
      largest = std::max(largest, std::abs(mode.sensor_values[k]));
    }
    for (std::size_t i = 0; i < wanted.modes.size(); ++i) {
      EXPECT_NEAR(found.modes[i].sensor_values[k], wanted.modes[i].sensor_values[k],
                  kWorkingValues * largest)
          << to_string(sensors[k]) << ", mode " << i;
    }
  }
  for (std::size_t i = 0; i < wanted.modes.size(); ++i) {
    const double omega = wanted.modes[i].omega_rad_per_s;
    EXPECT_NEAR(found.modes[i].omega_rad_per_s, omega, kWorkingRounding * omega) << i;
    EXPECT_NEAR(found.modes[i].hub_slope, wanted.modes[i].hub_slope, kWorkingValues) << i;
  }
  const double damping = *std::ranges::max_element(wanted.damping_rad_per_s);
  for (std::size_t i = 0; i < wanted.damping_rad_per_s.size(); ++i) {
    EXPECT_NEAR(found.damping_rad_per_s[i], wanted.damping_rad_per_s[i], kWorkingValues * damping);
  }
}

TEST_P(InWorkingArithmetic, TransferFunctionsAreTheSame) {
  const auto sensors = read_sensors();
  for (const double size : {1e-2, 0.3, 4.0, 50.0, 700.0}) {
    for (const PlainComplex s : {PlainComplex(0.0, size), PlainComplex(-0.2 * size, size)}) {
      const auto wanted = extended_.transfer_functions(sensors, s);
      const auto found = working_.transfer_functions(sensors, s);
      for (std::size_t k = 0; k < sensors.size(); ++k) {
        EXPECT_LE(working_error(found[k], wanted[k]), kWorkingValues)
            << to_string(sensors[k]) << " at s = " << s;
      }
    }
  }
}

TEST_P(InWorkingArithmetic, PolesAndZerosAreTheSame) {
  constexpr std::size_t kWorkingRoots = 10;
  const auto wanted = extended_.damped_poles(kWorkingRoots);
  const auto found = working_.damped_poles(kWorkingRoots);
  EXPECT_TRUE(found.summary.converged);
  for (std::size_t i = 0; i < kWorkingRoots; ++i) {
    EXPECT_LE(working_error(found.flexible[i].first_rad_per_s, wanted.flexible[i].first_rad_per_s),
              kWorkingValues)
        << i;
  }
  for (const arm::Sensor& sensor : read_sensors()) {
    const auto exact = extended_.zeros(sensor, kWorkingRoots);
    const auto zeros = working_.zeros(sensor, kWorkingRoots);
    EXPECT_EQ(zeros.count.expected, zeros.count.found) << to_string(sensor);
    ASSERT_EQ(zeros.s_rad_per_s.size(), exact.s_rad_per_s.size()) << to_string(sensor);
    for (std::size_t i = 0; i < zeros.s_rad_per_s.size(); ++i) {
      EXPECT_LE(working_error(zeros.s_rad_per_s[i], exact.s_rad_per_s[i]), kWorkingValues)
          << to_string(sensor) << ", zero " << i;
    }
  }
}

std::vector<arm::Arm> every_arm() {
  std::vector<arm::Arm> arms = arms_without_closed_form();
  arms.push_back(unit_arm(0.1, 0.5, 0.02, 1e-3, 0.2));
  arms.push_back(arm::paper_arm());
  return arms;
}

INSTANTIATE_TEST_SUITE_P(Arms, InWorkingArithmetic, testing::ValuesIn(every_arm()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

}  // namespace
}  // namespace flexarm::exact_tf
