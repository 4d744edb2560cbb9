#include "report/figures/phase.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
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

TEST(PhaseOfResponse, WrappedKeepsTheMultiplesOf90DegAwayFromTheCut) {
  const double e = 1e-6;
  const auto phase =
      phase_deg(at_angles({0, 180 - e, 180 + e, 90 + e, -90, 134, 136}), Phase::wrapped);
  const std::vector<double> expected{0, -180 - e, -180 + e, 90 + e, -90, 134, -224};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(phase[i], expected[i], 1e-9);
}

TEST(PhaseOfResponse, UnwrappedGoesOnOverFullTurns) {
  std::vector<double> falling;
  for (double angle = -30; angle > -900; angle -= 100) falling.push_back(angle);
  const auto phase = phase_deg(at_angles(falling), Phase::unwrapped);
  for (std::size_t i = 0; i < falling.size(); ++i) EXPECT_NEAR(phase[i], falling[i], 1e-9);
}

/// 1/(1 - w^2) (4 - w^2)/(9 - w^2): pole, zero, pole on the imaginary axis.
std::vector<std::complex<double>> undamped(const std::vector<double>& omega, bool with_zero) {
  std::vector<std::complex<double>> values;
  for (const double w : omega) {
    values.emplace_back((with_zero ? 4.0 - w * w : 1.0) / ((1.0 - w * w) * (9.0 - w * w)));
  }
  return values;
}

TEST(PhaseOfResponse, AnUndampedOneFallsAtAPoleAndRisesAtAZero) {
  const std::vector<double> omega = {0.1, 0.9, 1.1, 1.5, 1.9, 2.1, 2.5, 2.9, 3.1, 4.0};
  EXPECT_THAT(phase_deg(undamped(omega, true), Phase::unwrapped),
              ElementsAre(0, 0, -180, -180, -180, 0, 0, 0, -180, -180));
  EXPECT_THAT(phase_deg(undamped(omega, false), Phase::unwrapped),
              ElementsAre(0, 0, -180, -180, -180, -180, -180, -180, -360, -360));
}

TEST(PhaseOfResponse, AHalfTurnThatNothingExplainsStaysNearAPassiveResponse) {
  EXPECT_THAT(phase_deg({-1.0, 1.0, -1.0}, Phase::unwrapped), ElementsAre(-180, 0, -180));
}

TEST(PhaseOfResponse, ADelayDoesNotTurnAZeroRound) {
  const std::vector<double> omega = {1.5, 1.8, 1.95, 2.05, 2.2, 2.5};
  auto values = undamped(omega, true);
  constexpr double kDelay = 0.01;
  for (std::size_t i = 0; i < omega.size(); ++i) values[i] *= std::polar(1.0, -omega[i] * kDelay);
  const auto phase = phase_deg(values, Phase::unwrapped);
  EXPECT_NEAR(phase.front(), -180.0, 1.0);
  EXPECT_NEAR(phase.back(), 0.0, 2.0);
}

TEST(PhaseOfResponse, ZeroHasNone) {
  EXPECT_THAT(phase_deg({1.0, 0.0, -1.0}, Phase::wrapped), ElementsAre(0, IsNan(), -180));
}

}  // namespace
}  // namespace flexarm::report
