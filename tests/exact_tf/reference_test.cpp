#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"
#include "tests/reference/reference_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

namespace flexarm::exact_tf {
namespace {

using reference::ReferenceResponse;

class Reference : public testing::TestWithParam<reference::ReferenceCase> {
 protected:
  ExactArm exact_{arm_of(GetParam())};

  static void expect_all_near(const std::vector<double>& found, std::span<const double> expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], kRelativeTolerance * expected[i]) << "root " << i + 1;
    }
  }
};

TEST_P(Reference, PolesAgree) {
  const int count = static_cast<int>(GetParam().pole_lambda.size());
  expect_all_near(exact_.pole_lambdas(count), GetParam().pole_lambda);
  std::vector<double> frequencies_Hz;
  for (const double omega : exact_.poles(count).omega_rad_per_s) {
    frequencies_Hz.push_back(omega / (2.0 * std::numbers::pi));
  }
  expect_all_near(frequencies_Hz, GetParam().pole_Hz);
}

TEST_P(Reference, HubZerosAgree) {
  const int count = static_cast<int>(GetParam().hub_zero_lambda.size());
  expect_all_near(exact_.hub_zero_lambdas(count), GetParam().hub_zero_lambda);
  std::vector<double> frequencies_Hz;
  for (const auto& zero : exact_.zeros({arm::SensorKind::hub_angle}, count).s_rad_per_s) {
    EXPECT_EQ(zero.real(), 0.0);
    frequencies_Hz.push_back(zero.imag() / (2.0 * std::numbers::pi));
  }
  expect_all_near(frequencies_Hz, GetParam().hub_zero_Hz);
}

TEST_P(Reference, ResponsesAgree) {
  const double quarter_m = exact_.arm().beam.length_m / 4.0;
  for (const ReferenceResponse& point : GetParam().responses) {
    const auto s = point.s_rad_per_s;
    const auto expect_near = [&](const arm::Sensor& sensor, std::complex<double> expected) {
      EXPECT_LE(std::abs(exact_.transfer_function(sensor, s) - expected),
                kRelativeTolerance * std::abs(expected))
          << to_string(sensor) << " at s = " << s;
    };
    expect_near({arm::SensorKind::hub_angle}, point.hub_angle);
    expect_near({arm::SensorKind::tip_displacement}, point.tip_displacement);
    expect_near({arm::SensorKind::strain, quarter_m}, point.curvature_quarter);
  }
}

INSTANTIATE_TEST_SUITE_P(SevenCases, Reference, testing::ValuesIn(reference::reference_cases()),
                         reference::name_of_case);

}  // namespace
}  // namespace flexarm::exact_tf
