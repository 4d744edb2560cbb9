#include "response/frequency/continuous_phase.hpp"

#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/response_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

const arm::Sensor kHub{arm::SensorKind::hub_angle, 0.0};
const arm::Sensor kTip{arm::SensorKind::tip_acceleration, 0.0};

/// Phases of the sensors at these frequencies, or on a grid up to the last where there are none.
FrequencyResponse phases_of(const arm::Arm& arm, std::vector<double> frequency_Hz,
                            const std::string& formulation = "exact_tf", int points = 300) {
  ResponseOptions options;
  options.sensors = {kHub, kTip};
  options.modes = 3;
  options.points = points;
  options.frequency_Hz = std::move(frequency_Hz);
  return study_response(arm, make_formulation(formulation, arm, 8), options).response;
}

/// The phase of an undamped arm is a multiple of 90 deg, to the rounding of arg.
constexpr double kRounding_deg = 1e-9;

TEST(ContinuousPhase, OfAnUndampedArmCountsItsPolesAndZeros) {
  // Zeros of the hub angle at 2.87 and 18.0 Hz, poles at 11.9 and 32.3 Hz; the tip has no zero on
  // the imaginary axis.
  const auto phases = phases_of(arm::paper_arm(), {0.1, 2.0, 5.0, 15.0, 25.0, 40.0});
  const std::vector<double> hub = {-180, -180, 0, -180, 0, -180};
  const std::vector<double> tip = {0, 0, 0, -180, -180, -360};
  for (std::size_t i = 0; i < hub.size(); ++i) {
    EXPECT_NEAR(phases.phase_deg[0][i], hub[i], kRounding_deg) << i;
    EXPECT_NEAR(phases.phase_deg[1][i], tip[i], kRounding_deg) << i;
  }
}

arm::Arm delayed_damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  effects::put(arm, "time_delay", {{"delay", 3e-3}});
  effects::put(arm, "actuator_lag", {{"time_constant", 2e-3}});
  return arm;
}

TEST(ContinuousPhase, IsTheSameOnEveryGrid) {
  for (const arm::Arm& arm : {arm::paper_arm(), delayed_damped_arm()}) {
    const auto fine = phases_of(arm, {});
    for (std::size_t i = 0; i < fine.frequency_Hz.size(); i += 7) {
      const auto alone = phases_of(arm, {fine.frequency_Hz[i]});
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(alone.phase_deg[k][0], fine.phase_deg[k][i]) << fine.frequency_Hz[i];
      }
    }
  }
}

/// On a grid that is fine at its poles and zeros nothing jumps by a half turn.
TEST(ContinuousPhase, IsContinuousThroughDampedPolesDelayAndLag) {
  const auto phases = phases_of(delayed_damped_arm(), {}, "exact_tf", 4000);
  for (const auto& phase : phases.phase_deg) {
    double largest = 0.0;
    for (std::size_t i = 1; i < phase.size(); ++i) {
      largest = std::fmax(largest, std::abs(phase[i] - phase[i - 1]));
    }
    EXPECT_LT(largest, 60.0);
  }
  // Delay and lag alone take more than a turn by the third pole.
  EXPECT_LT(phases.phase_deg[1].back(), -540.0);
}

TEST(ContinuousPhase, IsThatOfEveryFormulation) {
  const std::vector<double> frequency_Hz = {0.5, 2.8, 2.9, 11.0, 12.5, 31.0, 60.0};
  const auto exact = phases_of(delayed_damped_arm(), frequency_Hz);
  for (const std::string name : {"fem", "assumed_modes"}) {
    const auto other = phases_of(delayed_damped_arm(), frequency_Hz, name);
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
        EXPECT_NEAR(other.phase_deg[k][i], exact.phase_deg[k][i], 1e-4) << name;
      }
    }
  }
}

/// A spring at the hub: the lowest pole is one more, and the phase begins at 0.
TEST(ContinuousPhase, OfARestrainedHubBeginsAtZero) {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "hub_spring", {{"stiffness", 1.0}});
  const auto phases = phases_of(arm, {0.05, 2.9});
  EXPECT_NEAR(phases.phase_deg[0][0], 0.0, kRounding_deg);
}

TEST(ContinuousPhase, OfANegativeGainIsHalfATurnLower) {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "torque_gain", {{"factor", -1.0}});
  EXPECT_NEAR(phases_of(arm, {0.1}).phase_deg[0][0], -360.0, kRounding_deg);
}

TEST(ContinuousPhase, OfZeroIsNone) {
  const PhaseReference reference;
  const std::vector<double> frequency_Hz = {1.0, 2.0};
  const std::vector<std::complex<double>> values = {0.0, -1.0};
  const auto phases = continuous_phase_deg(reference, frequency_Hz, values);
  EXPECT_TRUE(std::isnan(phases[0]));
  EXPECT_NEAR(std::abs(phases[1]), 180.0, kRounding_deg);
}

}  // namespace
}  // namespace flexarm::response
