// Gain, delay, lag and offset between a sensor and its reading.
#include "arm/input_error.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/reading_times.hpp"
#include "simulation_models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexarm::response {
namespace {

constexpr double kPathStep_s = 1e-2;

/// A few hundred steps of readings of size 1 to 10.
constexpr double kPathRounding = 1e-12;

Simulation read_from(const ArmParts& parts, const arm::ModalModel& model,
                     const std::vector<double>& torque, double step_s = kPathStep_s) {
  return simulate(model, parts, hub_sensors(), torque, {.sample_time_s = step_s, .energy = false});
}

/// A free hub of inertia 1, of which a torque of 1 makes theta = t^2/2.
Simulation hub_read_by(const SensorChain& chain, double torque_delay_s = 0.0) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  parts.actuator.delay_s = torque_delay_s;
  parts.sensor_chains = {chain};
  return read_from(parts, oscillator(1.0, 0.0), step_torque(1.0, 300));
}

TEST(SensorPath, ADelayedReadingIsTheValueAtTheDelayedInstant) {
  for (const double delay_s : {2.0 * kPathStep_s, 0.3 * kPathStep_s, 0.0734, 1.0 / 3.0, 1e-7}) {
    for (const double torque_delay_s : {0.0, 0.7 * kPathStep_s, 0.0237}) {
      const auto made = hub_read_by({.sensor = kHubAngle, .delay_s = delay_s}, torque_delay_s);
      for (std::size_t k = 0; k < made.time_s.size(); ++k) {
        const double t = std::max(0.0, made.time_s[k] - torque_delay_s);
        const double late = std::max(0.0, made.time_s[k] - torque_delay_s - delay_s);
        ASSERT_NEAR(made.channels[0][k], 0.5 * late * late, kPathRounding) << delay_s << ", " << k;
        ASSERT_NEAR(made.channels[1][k], t, kPathRounding) << "the other sensor is not late";
      }
    }
  }
}

TEST(SensorPath, FollowsTheOrderGainDelayLagOffset) {
  constexpr double kLag_s = 0.05;
  constexpr double kDelay_s = 0.0234;
  const auto made = hub_read_by(
      {.sensor = kHubVelocity, .gain = -1.4, .delay_s = kDelay_s, .lag_s = kLag_s, .offset = 0.3});
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    // A lag of a ramp; were the offset before it, the reading would begin at 0.
    const double t = std::max(0.0, made.time_s[k] - kDelay_s);
    const double lagged = t + kLag_s * std::expm1(-t / kLag_s);
    ASSERT_NEAR(made.channels[1][k], -1.4 * lagged + 0.3, kPathRounding) << k;
  }
}

/// With dry friction, rests and reversals between samples: the reading of a sensor that is 0.4
/// samples late is that of one on time, at samples five times as dense.
TEST(SensorPath, ADelayIsExactWhereFrictionHoldsAndTurnsTheHub) {
  constexpr std::size_t kDenser = 5;
  ArmParts parts = coulomb(0.7);
  const arm::ModalModel model = two_masses(0.6, 0.4, 30.0);
  std::vector<double> torque;
  for (int k = 0; k < 300; ++k) torque.push_back(std::sin(0.11 * k) + 0.3 * std::sin(0.63 * k));
  std::vector<double> dense_torque;
  for (const double sample : torque) dense_torque.insert(dense_torque.end(), kDenser, sample);
  const auto dense = read_from(parts, model, dense_torque, kPathStep_s / kDenser);
  put(parts, "sensor_delay", {{"delay", 0.4 * kPathStep_s}}, "hub_angle");
  put(parts, "sensor_gain", {{"factor", 2.0}}, "hub_angle");
  put(parts, "sensor_offset", {{"value", 5.0}}, "hub_angle");
  const auto late = read_from(parts, model, torque);
  ASSERT_GT(late.summary.stops, 2);
  ASSERT_GT(late.summary.stick_time_s, 0.0);
  EXPECT_EQ(late.channels[0][0], 5.0);
  for (std::size_t k = 1; k < late.time_s.size(); ++k) {
    ASSERT_NEAR(late.channels[0][k], 5.0 + 2.0 * dense.channels[0][kDenser * k - 2], kPathRounding);
    ASSERT_NEAR(late.channels[1][k], dense.channels[1][kDenser * k], kPathRounding);
  }
}

TEST(SensorPath, AHubThatFrictionHoldsReadsItsOffsetToTheLastBit) {
  ArmParts parts = coulomb(1.0);
  put(parts, "sensor_offset", {{"value", 0.1}}, "hub_velocity");
  put(parts, "sensor_delay", {{"delay", 0.5 * kPathStep_s}}, "hub_velocity");
  const auto made = read_from(parts, oscillator(1.0, 0.0), step_torque(0.5, 40));
  EXPECT_THAT(made.channels[0], testing::Each(0.0));
  EXPECT_THAT(made.channels[1], testing::Each(0.1));
}

TEST(SensorPath, ADelayBeyondTheRecordLeavesTheOffsetAlone) {
  const auto made = hub_read_by({.sensor = kHubAngle, .delay_s = 1e12, .offset = -2.0});
  EXPECT_THAT(made.channels[0], testing::Each(-2.0));
}

/// From an initial state the arm moves before the first sample too: a late sensor shows that.
TEST(SensorPath, AFreeStartReadsTheMotionBeforeTheFirstSample) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  parts.sensor_chains = {{.sensor = kHubAngle, .delay_s = 3.4 * kPathStep_s}};
  const arm::ModalModel model = oscillator(1.0, 0.0);
  const ArmSimulator simulator(model, parts, hub_sensors(),
                               options_of_fit(kPathStep_s, TorqueHold::zero));
  Eigen::VectorXd state = Eigen::VectorXd::Zero(simulator.states());
  state(1) = 2.0;  // rad/s, four samples before the first
  const auto made = simulator.readings(step_torque(0.0, 20), state);
  for (Eigen::Index k = 0; k < made.rows(); ++k) {
    EXPECT_NEAR(made(k, 0), 2.0 * kPathStep_s * (static_cast<double>(k) + 4.0 - 3.4),
                kPathRounding);
    EXPECT_NEAR(made(k, 1), 2.0, kPathRounding);
  }
}

TEST(SensorPath, StagesOfOneKindComeTogetherAndASecondLagIsRefusedByName) {
  ArmParts parts;
  const auto stage = [&](const char* name, auto what) {
    arm::EffectDefinition definition{.name = name, .meaning = "", .parameters = {}};
    definition.sensor_path = [what](const arm::Effect& /*effect*/) {
      return arm::SensorStage{kHubAngle, what};
    };
    add_effect(parts, {.definition = std::make_shared<const arm::EffectDefinition>(definition)});
  };
  stage("first_gain", arm::Gain{2.0});
  stage("second_gain", arm::Gain{-1.5});
  stage("first_delay", arm::Delay{0.1});
  stage("second_delay", arm::Delay{0.2});
  stage("first_offset", arm::Offset{1.0});
  stage("second_offset", arm::Offset{0.5});
  stage("first_lag", arm::Lag{0.3});
  ASSERT_EQ(parts.sensor_chains.size(), 1U);
  const SensorChain chain = chain_of(parts.sensor_chains, kHubAngle);
  EXPECT_EQ(chain.gain, -3.0);
  EXPECT_NEAR(chain.delay_s, 0.3, 1e-15);
  EXPECT_EQ(chain.lag_s, 0.3);
  EXPECT_EQ(chain.offset, 1.5);
  EXPECT_EQ(chain_of(parts.sensor_chains, kHubVelocity), SensorChain{kHubVelocity});
  try {
    stage("second_lag", arm::Lag{0.1});
    ADD_FAILURE() << "a second lag was accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("effects.second_lag: port sensor_path"));
  }
}

TEST(ReadingTimes, DivideADelayIntoSamplesAndAPartOfOne) {
  const std::vector<SensorChain> chains = {{.sensor = kHubAngle, .delay_s = 2.25},
                                           {.sensor = kTipAcceleration, .delay_s = 3.0}};
  const std::vector<arm::Sensor> sensors = {kHubAngle, kHubVelocity, kTipAcceleration};
  const ReadingTimes times = reading_times(chains, sensors, 1.0);
  EXPECT_THAT(times.cuts(), testing::ElementsAre(0.75));
  EXPECT_EQ(times.sensors[0].samples_later, 3);
  EXPECT_EQ(times.sensors[1].samples_later, 0);
  EXPECT_EQ(times.sensors[2].at, 0.0);
  EXPECT_EQ(times.sensors[2].samples_later, 3);
  EXPECT_EQ(times.longest_samples(), 3);
}

}  // namespace
}  // namespace flexarm::response
