#include "report/figures/phase.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace flexarm::report {
namespace {

using testing::ElementsAre;
using testing::IsNan;

std::vector<std::complex<double>> at_angles(const std::vector<double>& angles_deg) {
  std::vector<std::complex<double>> values;
  for (const double angle : angles_deg) {
    values.push_back(std::polar(2.0, angle * std::numbers::pi / 180.0));
  }
  return values;
}

TEST(PrincipalPhase, KeepsTheMultiplesOf90DegAwayFromTheCut) {
  const double e = 1e-6;
  const auto phase = principal_phase_deg(at_angles({0, 180 - e, 180 + e, 90 + e, -90, 134, 136}));
  const std::vector<double> expected{0, -180 - e, -180 + e, 90 + e, -90, 134, -224};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(phase[i], expected[i], 1e-9);
}

TEST(PrincipalPhase, DoesNotDependOnNeighbours) {
  auto values = at_angles({10, -100, 170, -340, 20});
  const auto phase = principal_phase_deg(values);
  std::ranges::reverse(values);
  auto reversed = principal_phase_deg(values);
  std::ranges::reverse(reversed);
  EXPECT_EQ(phase, reversed);
}

std::vector<double> rounded(std::vector<double> values) {
  for (double& value : values) value = std::round(1e6 * value) / 1e6;
  return values;
}

TEST(ContinuousPhase, FollowsAResonanceBeyondTheCut) {
  const auto phase = continuous_phase_deg(at_angles({-100, -170, -220, -230, -340, -400, -500}));
  EXPECT_THAT(rounded(phase), ElementsAre(-100, -170, -220, -230, -340, -400, -500));
}

TEST(ContinuousPhase, GoesOnBehindAValueThatHasNone) {
  auto values = at_angles({-170, 0, -240});
  values[1] = 0.0;
  const auto phase = rounded(continuous_phase_deg(values));
  EXPECT_EQ(phase[0], -170);
  EXPECT_TRUE(std::isnan(phase[1]));
  EXPECT_EQ(phase[2], -240);
}

TEST(ContinuousPhase, OfAnUndampedArmStaysInOneTurn) {
  // A pole between two values turns a real response by half a turn, and so does a zero: neither
  // has a direction.
  EXPECT_THAT(continuous_phase_deg({1.0, -1.0, 1.0, -1.0, -1.0, 1.0}),
              ElementsAre(0, -180, 0, -180, -180, 0));
}

TEST(TurnTowards, MovesEachPieceByWholeTurnsToTheReference) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const PhaseCurve model{{1, 2, 3, 4, 5, 6}, {-10, -100, -190, -280, -370, -460}};
  PhaseCurve measured{{1, 2, 3, 4, 5, 6}, {-12, -95, kNone, 85, -5, -110}};
  turn_towards(model, measured);
  EXPECT_THAT(measured.phase_deg, ElementsAre(-12, -95, IsNan(), -275, -365, -470));
}

TEST(TurnTowards, GoesOnATurnNearerWhereACurveRunsAway) {
  // Half a turn up at the zero of an undamped arm, down at that of a fit to the right of the axis.
  const PhaseCurve model{{1, 2, 3, 4, 5, 6}, {0, -180, -180, 0, 0, -180}};
  PhaseCurve fit{{1, 2, 3, 4, 5, 6}, {0, -180, -200, -300, -358, -540}};
  turn_towards(model, fit);
  EXPECT_THAT(fit.phase_deg, ElementsAre(0, -180, -200, IsNan(), 2, -180));
}

TEST(PrincipalTurn, BringsTheFirstPhaseToItsPrincipalValue) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(to_principal_turn_deg({kNone, -540, 100}), 360.0);
  EXPECT_EQ(to_principal_turn_deg({-200, -900}), 0.0);
  EXPECT_EQ(to_principal_turn_deg({kNone}), 0.0);
}

TEST(TurnTowards, LeavesWhatTheReferenceDoesNotReach) {
  PhaseCurve measured{{7, 8}, {300, 310}};
  turn_towards({{1, 2}, {0, 0}}, measured);
  EXPECT_THAT(measured.phase_deg, ElementsAre(300, 310));
}

TEST(PrincipalPhase, ZeroHasNone) {
  EXPECT_THAT(principal_phase_deg({1.0, 0.0, -1.0}), ElementsAre(0, IsNan(), -180));
}

}  // namespace
}  // namespace flexarm::report
