#include "exact_tf/exact_arm.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <string>

namespace flexarm::exact_tf {
namespace {

/// The project's figure; the file has 25 digits or more.
constexpr double kRelativeTolerance = 1e-13;

double number(const nlohmann::json& text) {
  return std::stod(text.get<std::string>());
}

std::complex<double> complex_number(const nlohmann::json& pair) {
  return {number(pair.at(0)), number(pair.at(1))};
}

const nlohmann::json& reference() {
  static const nlohmann::json cases = [] {
    std::ifstream file(FLEXARM_SOURCE_DIR "/tests/exact_tf/reference.json");
    return nlohmann::json::parse(file);
  }();
  return cases;
}

/// The arm of a case, with a thickness of 2 m so that strain is curvature.
arm::Arm arm_of(const nlohmann::json& reference_case) {
  arm::Arm arm;
  arm.beam =
      arm::Beam::from_rigidity(number(reference_case.at("l")), number(reference_case.at("EI")),
                               number(reference_case.at("rho")));
  arm.beam.thickness_m = 2.0;
  arm.hub.inertia_kg_m2 = number(reference_case.at("Ih"));
  arm.payload.mass_kg = number(reference_case.at("Mp"));
  arm.payload.inertia_kg_m2 = number(reference_case.at("Ip"));
  return arm;
}

class Reference : public testing::TestWithParam<std::string> {
 protected:
  const nlohmann::json& case_ = reference().at(GetParam());
  ExactArm exact_{arm_of(case_)};

  static void expect_all_near(const std::vector<double>& found, const nlohmann::json& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double value = number(expected.at(i));
      EXPECT_NEAR(found[i], value, kRelativeTolerance * value) << "root " << i + 1;
    }
  }
};

TEST_P(Reference, PolesAgree) {
  const int count = static_cast<int>(case_.at("pole_lambda").size());
  expect_all_near(exact_.pole_lambdas(count), case_.at("pole_lambda"));
  std::vector<double> frequencies_Hz;
  for (const double omega : exact_.poles(count).omega_rad_per_s) {
    frequencies_Hz.push_back(omega / (2.0 * std::numbers::pi));
  }
  expect_all_near(frequencies_Hz, case_.at("pole_hz"));
}

TEST_P(Reference, HubZerosAgree) {
  const int count = static_cast<int>(case_.at("hub_zero_lambda").size());
  expect_all_near(exact_.hub_zero_lambdas(count), case_.at("hub_zero_lambda"));
  std::vector<double> frequencies_Hz;
  for (const auto& zero : exact_.zeros({arm::SensorKind::hub_angle}, count).s_rad_per_s) {
    EXPECT_EQ(zero.real(), 0.0);
    frequencies_Hz.push_back(zero.imag() / (2.0 * std::numbers::pi));
  }
  expect_all_near(frequencies_Hz, case_.at("hub_zero_hz"));
}

TEST_P(Reference, ResponsesAgree) {
  const double quarter_m = exact_.arm().beam.length_m / 4.0;
  for (const auto& point : case_.at("transfer")) {
    const auto s = complex_number(point.at("s"));
    const auto expect_near = [&](const arm::Sensor& sensor, const char* key) {
      const auto expected = complex_number(point.at(key));
      EXPECT_LE(std::abs(exact_.transfer_function(sensor, s) - expected),
                kRelativeTolerance * std::abs(expected))
          << key << " at s = " << s;
    };
    expect_near({arm::SensorKind::hub_angle}, "hub_angle");
    expect_near({arm::SensorKind::tip_displacement}, "tip_displacement");
    expect_near({arm::SensorKind::strain, quarter_m}, "curvature_quarter");
  }
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& [name, value] : reference().items()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(SevenCases, Reference, testing::ValuesIn(case_names()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace flexarm::exact_tf
