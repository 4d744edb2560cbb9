#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <complex>
#include <fstream>
#include <string>

namespace flexarm::assumed_modes {
namespace {

/// Omega is rounded to double, as is the frequency scale: 2^-53 each, and a few operations.
constexpr double kRounding = 1e-15;
/// Zeros away from the hub: each next one is 40 times worse conditioned (a motion that dies out
/// from tip to hub is to be told from zero); the sixth is left with 1e-9 of 64 bits.
constexpr double kTipZeroRounding = 1e-9;
/// The project's figures.
constexpr double kIssuePoles = 1e-10;
constexpr double kIssueTipZeros = 1e-8;
constexpr double kIssueTransfer = 1e-9;

using Json = nlohmann::json;

const Json& reference() {
  static const Json cases = [] {
    std::ifstream file(FLEXARM_SOURCE_DIR "/tests/assumed_modes/exact_reference.json");
    return Json::parse(file);
  }();
  return cases;
}

double number(const Json& text) {
  return std::stod(text.get<std::string>());
}

std::complex<double> complex_number(const Json& pair) {
  return {number(pair[0]), number(pair[1])};
}

arm::Arm arm_of(const Json& values) {
  arm::Arm arm;
  arm.beam =
      arm::Beam::from_rigidity(number(values["l"]), number(values["EI"]), number(values["rho"]));
  arm.beam.thickness_m = 2.0;  // so that strain is curvature
  arm.hub.inertia_kg_m2 = number(values["Ih"]);
  arm.payload = {number(values["Mp"]), number(values["Ip"])};
  return arm;
}

double omega(const Json& lambda, const arm::Arm& arm) {
  return std::pow(number(lambda), 2) * arm::omega_scale_rad_per_s(arm);
}

double pole_error(const AssumedModesArm& model, const Json& values) {
  double worst = 0.0;
  const auto poles = model.poles(10).omega_rad_per_s;
  for (std::size_t i = 0; i < 10; ++i) {
    worst =
        std::max(worst, std::abs(poles.at(i) / omega(values["pole_lambda"][i], model.arm()) - 1));
  }
  return worst;
}

double hub_zero_error(const AssumedModesArm& model, const Json& values) {
  double worst = 0.0;
  const auto zeros = model.zeros(testing_arms::kHubAngle, 10).s_rad_per_s;
  for (std::size_t i = 0; i < 10; ++i) {
    const std::complex<double> exact(0.0, omega(values["hub_zero_lambda"][i], model.arm()));
    worst = std::max(worst, std::abs(zeros.at(i) / exact - 1.0));
  }
  return worst;
}

/// The reference lists real zeros only; a payload's inertia adds a pair on the imaginary axis.
double tip_zero_error(const AssumedModesArm& model, const Json& values) {
  double worst = 0.0;
  std::size_t real = 0;
  for (const auto& s : model.zeros(testing_arms::kTipAcceleration, 8).s_rad_per_s) {
    if (s.real() == 0.0 || real == 6) continue;
    const double exact = number(values["tip_zero_alpha_rad_s"][real++]);
    worst = std::max(worst, std::abs(s / exact - 1.0));
  }
  return real == 6 ? worst : 1.0;
}

double transfer_error(const AssumedModesArm& model, const Json& values) {
  double worst = 0.0;
  const auto compare = [&](const arm::Sensor& sensor, const Json& at, const char* key) {
    const auto exact = complex_number(at[key]);
    worst = std::max(
        worst, std::abs(model.transfer_function(sensor, complex_number(at["s"])) / exact - 1.0));
  };
  for (const Json& at : values["transfer"]) {
    compare(testing_arms::kHubAngle, at, "hub_angle");
    compare(testing_arms::kTipDisplacement, at, "tip_displacement");
    compare(testing_arms::strain_at(model.arm().beam.length_m / 4), at, "curvature_quarter");
  }
  return worst;
}

TEST(Reference, ThirtySixLegendreFunctionsGiveTenPolesAndZerosOfEveryCase) {
  ASSERT_EQ(reference().size(), 7U);
  for (const auto& [name, values] : reference().items()) {
    const AssumedModesArm model(arm_of(values), {Basis::legendre, 36});
    EXPECT_LE(pole_error(model, values), kRounding) << name;
    EXPECT_LE(hub_zero_error(model, values), kRounding) << name;
    EXPECT_LE(tip_zero_error(model, values), kTipZeroRounding) << name;
    EXPECT_LE(transfer_error(model, values), 1e-14) << name;
    EXPECT_EQ(model.zeros(testing_arms::kTipAcceleration, 6).infinite, 2) << name;
  }
}

TEST(Reference, TheIssuesFiguresHoldOnThePapersArmWithFewerFunctions) {
  const Json& values = reference()["paper"];
  const AssumedModesArm model(arm_of(values), {Basis::legendre, 28});
  EXPECT_LE(pole_error(model, values), kIssuePoles);
  EXPECT_LE(hub_zero_error(model, values), kIssuePoles);
  EXPECT_LE(tip_zero_error(model, values), kIssueTipZeros);
  EXPECT_LE(transfer_error(model, values), kIssueTransfer);
}

TEST(Reference, DefaultOptionsReachTheIssuesFigures) {
  const AssumedModesArm model(arm_of(reference()["paper"]));
  EXPECT_LE(model.degrees_of_freedom(), 36);
  EXPECT_LE(pole_error(model, reference()["paper"]), kIssuePoles);
}

TEST(Reference, MoreLegendreFunctionsLoseNothing) {
  for (const int functions : {48, 60, 120}) {
    for (const char* name : {"paper_payload_1kg", "unit_pinned_free", "unit_heavy_hub"}) {
      const Json& values = reference()[name];
      const AssumedModesArm model(arm_of(values), {Basis::legendre, functions});
      EXPECT_LE(pole_error(model, values), kRounding) << name << ' ' << functions;
      EXPECT_LE(hub_zero_error(model, values), kRounding) << name << ' ' << functions;
    }
  }
}

TEST(Reference, ShapesThatCarryThePayloadGiveHubZerosExactly) {
  for (const auto& [name, values] : reference().items()) {
    const AssumedModesArm model(arm_of(values), {Basis::clamped_with_payload, 11});
    EXPECT_LE(hub_zero_error(model, values), kRounding) << name;
  }
}

TEST(Reference, PinnedFreeShapesAreTheModesOfAnArmWithoutHub) {
  const Json& values = reference()["unit_pinned_free"];
  const AssumedModesArm model(arm_of(values), {Basis::pinned_free, 11});
  EXPECT_LE(pole_error(model, values), kRounding);
}

}  // namespace
}  // namespace flexarm::assumed_modes
