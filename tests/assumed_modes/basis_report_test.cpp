#include "assumed_modes/basis_report.hpp"

#include "assumed_modes/assumed_modes_arm.hpp"
#include "effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::assumed_modes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_arms::unit_arm;

/// A fit over n = 12 to 64 with k = 3 still sees k/n: measured up to 0.4 of the order 7.
constexpr double kFitSlow = 0.2;
constexpr double kFitFast = 0.6;

TEST(BasisReport, ShapesWithoutPayloadMissItsShear) {
  const auto report = describe_convergence(unit_arm(0.004, 0.3, 0.0), Basis::clamped_free);
  EXPECT_THAT(report.hub_zero.unmet, ElementsAre(UnmetCondition::tip_shear));
  EXPECT_EQ(report.pole.predicted_order, 3.0);
  EXPECT_NEAR(report.pole.measured_order, 3.0, kFitSlow);
  EXPECT_NEAR(report.hub_zero.measured_order, 3.0, kFitSlow);
  EXPECT_THAT(report.pole.sentence, HasSubstr("EI y''' = Mp y_tt"));
  EXPECT_THAT(report.pole.sentence, HasSubstr("use legendre or clamped_with_payload"));
  // 12 coordinates leave the third pole 3e-4 off.
  EXPECT_NEAR(std::log10(report.pole.relative_error[0]), -3.5, 0.2);
}

TEST(BasisReport, ShapesWithoutPayloadMissItsMoment) {
  const auto report = describe_convergence(unit_arm(0.1, 0.5, 0.02), Basis::clamped_free);
  EXPECT_EQ(report.pole.unmet.front(), UnmetCondition::tip_moment);
  EXPECT_EQ(report.pole.predicted_order, 1.0);
  EXPECT_NEAR(report.pole.measured_order, 1.0, kFitSlow);
  EXPECT_NEAR(report.hub_zero.measured_order, 1.0, kFitSlow);
  EXPECT_THAT(report.pole.sentence, HasSubstr("EI y'' = -Ip y'_tt"));
}

TEST(BasisReport, PinnedShapesMissTheMomentAtTheHub) {
  const auto report = describe_convergence(unit_arm(0.1, 0.0, 0.0), Basis::pinned_free);
  EXPECT_THAT(report.pole.unmet, ElementsAre(UnmetCondition::root_moment));
  EXPECT_EQ(report.pole.predicted_order, 1.0);
  EXPECT_NEAR(report.pole.measured_order, 1.0, kFitSlow);
  EXPECT_NEAR(report.hub_zero.measured_order, 1.0, kFitSlow);
  EXPECT_THAT(report.pole.sentence, HasSubstr("moment at the hub"));
}

TEST(BasisReport, ClampedShapesThatCarryThePayloadMissOnlyTheTurningOfTheHub) {
  for (const auto& arm :
       {unit_arm(0.004, 0.0, 0.0), unit_arm(0.004, 0.3, 0.0), unit_arm(0.004, 0.3, 0.001)}) {
    const auto report = describe_convergence(arm, Basis::clamped_with_payload);
    EXPECT_THAT(report.pole.unmet, ElementsAre(UnmetCondition::root_rotation));
    EXPECT_EQ(report.pole.predicted_order, 7.0);
    EXPECT_NEAR(report.pole.measured_order, 7.0, kFitFast);
    EXPECT_THAT(report.hub_zero.unmet, IsEmpty());
    for (const double error : report.hub_zero.relative_error) EXPECT_LE(error, 1e-15);
    EXPECT_THAT(report.hub_zero.sentence, HasSubstr("the functions are the exact mode shapes"));
  }
}

TEST(BasisReport, LegendreFunctionsConvergeFasterThanAnyPower) {
  const auto report = describe_convergence(unit_arm(0.1, 0.5, 0.02), Basis::legendre);
  EXPECT_THAT(report.pole.unmet, IsEmpty());
  EXPECT_TRUE(std::isinf(report.pole.predicted_order));
  // A power n^-q from 12 to 20 functions would need q > 14.
  EXPECT_LE(report.pole.relative_error[2], 1e-3 * report.pole.relative_error[0]);
  EXPECT_LE(report.pole.relative_error[2], 1e-14);
  EXPECT_THAT(report.pole.sentence, HasSubstr("converges exponentially"));
}

TEST(BasisReport, FourteenLegendreFunctionsBeatSixtyFourShapes) {
  const arm::Arm arm = unit_arm(0.004, 0.3, 0.0);
  const auto exact = AssumedModesArm(arm).poles(3).omega_rad_per_s[2];
  const auto legendre = AssumedModesArm(arm, {Basis::legendre, 14}).poles(3).omega_rad_per_s[2];
  EXPECT_LE(legendre / exact - 1.0, 1e-11);
  const auto shapes = AssumedModesArm(arm, {Basis::clamped_free, 64}).poles(3).omega_rad_per_s[2];
  EXPECT_GE(shapes / exact - 1.0, 1e-6);
}

TEST(BasisReport, EffectsAddConditionsOfTheirOwn) {
  const arm::Arm radius =
      testing_arms::with(unit_arm(0.1, 0.0, 0.0), "hub_radius", {{"radius", 0.5}});
  const auto moved = describe_convergence(radius, Basis::clamped_with_payload);
  EXPECT_EQ(moved.pole.unmet.front(), UnmetCondition::root_displacement);
  EXPECT_NEAR(moved.pole.measured_order, 5.0, kFitFast);
  EXPECT_THAT(moved.hub_zero.unmet, IsEmpty());
  const arm::Arm hanging =
      testing_arms::with(unit_arm(0.1, 0.0, 0.0), "gravity", {{"acceleration", 5.0}});
  const auto hangs = describe_convergence(hanging, Basis::clamped_free);
  EXPECT_EQ(hangs.hub_zero.unmet.front(), UnmetCondition::root_displacement);
  EXPECT_NEAR(hangs.hub_zero.measured_order, 5.0, kFitFast);
  EXPECT_NEAR(hangs.pole.measured_order, 5.0, kFitFast);
  const arm::Arm sprung =
      testing_arms::with(unit_arm(0.0, 0.0, 0.0), "hub_spring", {{"stiffness", 5.0}});
  const auto held = describe_convergence(sprung, Basis::pinned_free);
  EXPECT_EQ(held.pole.unmet.front(), UnmetCondition::root_moment);
  EXPECT_NEAR(held.pole.measured_order, 1.0, kFitSlow);
}

TEST(BasisReport, RefusesARootBeyondTheReference) {
  EXPECT_THROW(describe_convergence(unit_arm(0.1, 0.0, 0.0), Basis::legendre, 9),
               std::invalid_argument);
}

}  // namespace
}  // namespace flexarm::assumed_modes
