#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "tests/reference/reference_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace flexarm::assumed_modes {
namespace {

using testing_arms::kTipZeroRounding;

/// Omega is rounded to double, as is the frequency scale: 2^-53 each, and a few operations.
constexpr double kFrequencyRounding = 1e-15;
/// The project's figures.
constexpr double kIssuePoles = 1e-10;
constexpr double kIssueTipZeros = 1e-8;
constexpr double kIssueTransfer = 1e-9;

using reference::ReferenceCase;

double omega(double lambda, const arm::Arm& arm) {
  return std::pow(lambda, 2) * arm::omega_scale_rad_per_s(arm);
}

double pole_error(const AssumedModesArm& model, const ReferenceCase& values) {
  double worst = 0.0;
  const auto poles = model.poles(10).omega_rad_per_s;
  for (std::size_t i = 0; i < 10; ++i) {
    worst = std::max(worst, std::abs(poles.at(i) / omega(values.pole_lambda[i], model.arm()) - 1));
  }
  return worst;
}

double hub_zero_error(const AssumedModesArm& model, const ReferenceCase& values) {
  double worst = 0.0;
  const auto zeros = model.zeros(testing_arms::kHubAngle, 10).s_rad_per_s;
  for (std::size_t i = 0; i < 10; ++i) {
    const std::complex<double> exact(0.0, omega(values.hub_zero_lambda[i], model.arm()));
    worst = std::max(worst, std::abs(zeros.at(i) / exact - 1.0));
  }
  return worst;
}

/// The reference lists real zeros only; a payload's inertia adds a pair on the imaginary axis.
double tip_zero_error(const AssumedModesArm& model, const ReferenceCase& values) {
  double worst = 0.0;
  std::size_t real = 0;
  for (const auto& s : model.zeros(testing_arms::kTipAcceleration, 8).s_rad_per_s) {
    if (s.real() == 0.0 || real == 6) continue;
    const double exact = values.real_tip_zero_rad_per_s[real++];
    worst = std::max(worst, std::abs(s / exact - 1.0));
  }
  return real == 6 ? worst : 1.0;
}

double transfer_error(const AssumedModesArm& model, const ReferenceCase& values) {
  double worst = 0.0;
  const auto compare = [&](const arm::Sensor& sensor, std::complex<double> s,
                           std::complex<double> exact) {
    worst = std::max(worst, std::abs(model.transfer_function(sensor, s) / exact - 1.0));
  };
  for (const reference::ReferenceResponse& at : values.responses) {
    compare(testing_arms::kHubAngle, at.s_rad_per_s, at.hub_angle);
    compare(testing_arms::kTipDisplacement, at.s_rad_per_s, at.tip_displacement);
    compare(testing_arms::strain_at(model.arm().beam.length_m / 4), at.s_rad_per_s,
            at.curvature_quarter);
  }
  return worst;
}

TEST(Reference, ThirtySixLegendreFunctionsGiveTenPolesAndZerosOfEveryCase) {
  ASSERT_EQ(reference::reference_cases().size(), 7U);
  for (const ReferenceCase& values : reference::reference_cases()) {
    const AssumedModesArm model(arm_of(values), {Basis::legendre, 36});
    EXPECT_LE(pole_error(model, values), kFrequencyRounding) << values.name;
    EXPECT_LE(hub_zero_error(model, values), kFrequencyRounding) << values.name;
    EXPECT_LE(tip_zero_error(model, values), kTipZeroRounding) << values.name;
    EXPECT_LE(transfer_error(model, values), 1e-14) << values.name;
    EXPECT_EQ(model.zeros(testing_arms::kTipAcceleration, 6).infinite, 2) << values.name;
  }
}

TEST(Reference, TheIssuesFiguresHoldOnThePapersArmWithFewerFunctions) {
  const ReferenceCase& values = reference::case_named("paper");
  const AssumedModesArm model(arm_of(values), {Basis::legendre, 28});
  EXPECT_LE(pole_error(model, values), kIssuePoles);
  EXPECT_LE(hub_zero_error(model, values), kIssuePoles);
  EXPECT_LE(tip_zero_error(model, values), kIssueTipZeros);
  EXPECT_LE(transfer_error(model, values), kIssueTransfer);
}

TEST(Reference, DefaultOptionsReachTheIssuesFigures) {
  const AssumedModesArm model(arm_of(reference::case_named("paper")));
  EXPECT_LE(model.degrees_of_freedom(), 36);
  EXPECT_LE(pole_error(model, reference::case_named("paper")), kIssuePoles);
}

TEST(Reference, MoreLegendreFunctionsLoseNothing) {
  for (const int functions : {48, 60, 120}) {
    for (const char* name : {"paper_payload_1kg", "unit_pinned_free", "unit_heavy_hub"}) {
      const ReferenceCase& values = reference::case_named(name);
      const AssumedModesArm model(arm_of(values), {Basis::legendre, functions});
      EXPECT_LE(pole_error(model, values), kFrequencyRounding) << name << ' ' << functions;
      EXPECT_LE(hub_zero_error(model, values), kFrequencyRounding) << name << ' ' << functions;
    }
  }
}

TEST(Reference, ShapesThatCarryThePayloadGiveHubZerosExactly) {
  for (const ReferenceCase& values : reference::reference_cases()) {
    const AssumedModesArm model(arm_of(values), {Basis::clamped_with_payload, 11});
    EXPECT_LE(hub_zero_error(model, values), kFrequencyRounding) << values.name;
  }
}

TEST(Reference, PinnedFreeShapesAreTheModesOfAnArmWithoutHub) {
  const ReferenceCase& values = reference::case_named("unit_pinned_free");
  const AssumedModesArm model(arm_of(values), {Basis::pinned_free, 11});
  EXPECT_LE(pole_error(model, values), kFrequencyRounding);
}

}  // namespace
}  // namespace flexarm::assumed_modes
