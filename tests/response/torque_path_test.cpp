// What the commanded torque passes on its way to the hub.
#include "response/time/torque_path.hpp"

#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace flexarm::response {
namespace {

constexpr double kChainRounding = 1e-12;  // of values of order 1 over some thousand steps

/// The path's torque at `samples` (a time in sample intervals), from its pieces.
double at(const TorquePath& path, double samples) {
  TorquePath::Pieces pieces;
  const double k = std::floor(samples);
  path.pieces(static_cast<std::ptrdiff_t>(k), pieces);
  const double s = samples - k;
  for (const auto& piece : pieces) {
    if (s < piece.begin || s > piece.end) continue;
    const double r = (s - piece.begin) / (piece.end - piece.begin);
    return piece.begin_N_m + r * (piece.end_N_m - piece.begin_N_m);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(TorquePath, LinearTorqueIsDelayedMultipliedAndClippedInThisOrder) {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "torque_saturation", {{"limit", 1.25}});
  effects::put(arm, "torque_dead_zone", {{"width", 0.5}});
  effects::put(arm, "torque_gain", {{"factor", 2.0}});
  effects::put(arm, "time_delay", {{"delay", 1.7}});
  const Actuator actuator = take_apart(arm).actuator;
  const std::vector<double> torque = {0.3, 1.0, -2.0, 0.1, 3.0, 3.0, -0.2};
  const TorquePath path(actuator, torque, 1.0, TorqueHold::first);
  for (double t = 0.005; t < 8.0; t += 0.01) {
    const double delayed = t - 1.7;
    double command = 0.0;
    if (delayed >= 6.0) {
      command = torque.back();
    } else if (delayed >= 0.0) {
      const auto j = static_cast<std::size_t>(delayed);
      command = torque[j] + (delayed - static_cast<double>(j)) * (torque[j + 1] - torque[j]);
    }
    const double amplified = 2.0 * command;
    const double beyond = std::max(0.0, std::abs(amplified) - 0.5);
    EXPECT_NEAR(at(path, t), std::copysign(std::min(1.25, beyond), amplified), kChainRounding) << t;
  }
}

TEST(TorquePath, OfADelayBelowZeroLeadsItsSamplesAndEndsWithTheLast) {
  const std::vector<double> torque = {1.0, 2.0, 3.0};
  const TorquePath by_one({.delay_s = -1.0}, torque, 1.0, TorqueHold::zero);
  EXPECT_EQ(at(by_one, 0.5), 2.0);
  EXPECT_EQ(at(by_one, 1.5), 3.0);
  EXPECT_EQ(at(by_one, 2.5), 3.0);
  EXPECT_EQ(by_one.whole_parts(0).value(), (Eigen::MatrixXd(1, 3) << 2.0, 3.0, 3.0).finished());
  const TorquePath linear({.delay_s = -0.75}, torque, 1.0, TorqueHold::first);
  EXPECT_NEAR(at(linear, 0.5), 2.25, kChainRounding);
  EXPECT_NEAR(at(linear, 1.9), 3.0, kChainRounding);
}

TEST(TorquePath, HeldTorqueBreaksWhereTheDelayedSampleBegins) {
  const std::vector<double> torque = {1.0, 2.0, 3.0};
  const TorquePath path({.delay_s = 0.25}, torque, 1.0, TorqueHold::zero);
  TorquePath::Pieces pieces;
  path.pieces(1, pieces);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].end, 0.25);
  EXPECT_EQ(pieces[0].end_N_m, 1.0);
  EXPECT_EQ(pieces[1].begin_N_m, 2.0);
  EXPECT_EQ(pieces[1].part, 1U);
  EXPECT_TRUE(pieces[1].is_whole_part);
}

TEST(TorquePath, ADelayOfWholeSamplesUpToRoundingHasNoBreak) {
  const std::vector<double> torque = {1.0, 2.0, 3.0, 4.0};
  const TorquePath path({.delay_s = 3 * 0.1}, torque, 0.1, TorqueHold::zero);
  TorquePath::Pieces pieces;
  path.pieces(3, pieces);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].begin_N_m, 1.0);
}

/// A free hub of inertia 1 behind the actuator, which is easily integrated by hand.
Simulation free_hub(const Actuator& actuator, const std::vector<double>& torque, double h,
                    TorqueHold hold = TorqueHold::zero, double bias_N_m = 0.0) {
  ArmParts parts = coulomb(0.0);
  put(parts, "torque_bias", {{"torque", bias_N_m}});
  parts.actuator = actuator;
  return simulate(oscillator(1.0, 0.0), parts, hub_sensors(), torque,
                  {.sample_time_s = h, .hold = hold, .energy = false});
}

TEST(ActuatorChain, ADelayThatIsNoMultipleOfTheSampleTimeIsExact) {
  const double delay = 0.01234;
  const auto made = free_hub({.delay_s = delay}, step_torque(1.0, 200), 1e-3);
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double t = std::max(0.0, made.time_s[k] - delay);
    EXPECT_NEAR(made.channels[0][k], 0.5 * t * t, 1e-15);
    EXPECT_NEAR(made.channels[1][k], t, 1e-15);
  }
}

TEST(ActuatorChain, LagIsExactAlsoWhereItIsShorterThanTheSampleTime) {
  for (const double lag : {0.3, 1e-2, 1e-4}) {
    const auto made = free_hub({.lag_s = lag}, step_torque(1.0, 300), 1e-2, TorqueHold::zero, 0.25);
    for (std::size_t k = 0; k < made.time_s.size(); ++k) {
      const double t = made.time_s[k];
      const double rise = -std::expm1(-t / lag);
      EXPECT_NEAR(made.hub_torque_N_m[k], 0.25 + rise, kChainRounding);
      EXPECT_NEAR(made.channels[1][k], 0.25 * t + t - lag * rise, kChainRounding);
    }
  }
}

TEST(ActuatorChain, ARampIsClippedWhereItCrossesTheLimit) {
  const double h = 0.1;
  const arm::PiecewiseLinear clipped(0.0, {{-1.234, -1.234}, {1.234, 1.234}}, 0.0);
  std::vector<double> torque;
  for (int k = 0; k < 40; ++k) torque.push_back(h * k);
  const auto made = free_hub({.maps = {clipped}}, torque, h, TorqueHold::first);
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double t = std::min(made.time_s[k], 1.234);
    EXPECT_NEAR(made.channels[1][k], 0.5 * t * t + 1.234 * (made.time_s[k] - t), kChainRounding);
  }
}

TEST(ActuatorChain, RippleKeepsTheEnergyOfAPendulum) {
  ArmParts parts = coulomb(0.0);
  put(parts, "torque_ripple", {{"amplitude", -2.0}, {"cycles", 3.0}, {"phase", 0.4}});
  const double h = 1e-2;
  const auto made = simulate(oscillator(1.0, 0.0), parts, hub_sensors(), step_torque(0.0, 2000),
                             {.sample_time_s = h, .substeps = 4});
  const auto potential = [](double angle) { return -2.0 / 3.0 * std::cos(3.0 * angle + 0.4); };
  double widest = 0.0;
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double v = made.channels[1][k];
    widest = std::max(widest, std::abs(made.channels[0][k]));
    // Order 4: (omega dt)^4/2880 with omega^2 = 6 and some periods' growth.
    EXPECT_NEAR(0.5 * v * v + potential(made.channels[0][k]), potential(0.0), 1e-8);
  }
  EXPECT_GT(widest, 0.2);
  EXPECT_GT(made.summary.most_iterations, 1);
}

TEST(ActuatorChain, ARunWhoseStepsAreHalvedTooOftenIsGivenUp) {
  ArmParts parts = coulomb(0.0);
  put(parts, "torque_ripple", {{"amplitude", -2.0}, {"cycles", 3.0}, {"phase", 0.4}});
  // Too few iterations for steps of this length.
  SimulationOptions options{.sample_time_s = 0.1, .energy = false, .most_iterations = 3};
  const auto made = [&] {
    return simulate(oscillator(1.0, 0.0), parts, hub_sensors(), step_torque(0.0, 100), options)
        .summary.halved_steps;
  };
  const std::int64_t needed = made();
  ASSERT_GT(needed, 0);
  options.most_halved_steps = needed;
  EXPECT_EQ(made(), needed);
  options.most_halved_steps = needed - 1;
  EXPECT_THROW(made(), std::runtime_error);
}

TEST(ActuatorChain, HalvedStepsOfTablesAreCountedAndNotBounded) {
  ArmParts parts = coulomb(0.0);
  put(parts, "torque_ripple", {{"amplitude", -2.0}, {"cycles", 3.0}, {"phase", 0.4}});
  // A step of a sample turns the oscillator by 8 rad: there are tables for its halves and quarters,
  // and their forces converge before steps are short enough for a power series.
  const SimulationOptions options{
      .sample_time_s = 2.0, .energy = false, .most_halved_steps = 100, .resolve_every_mode = false};
  // Stribeck friction takes two or three of them a sample, which cost little.
  const Simulation made =
      simulate(oscillator(1.0, 16.0), parts, hub_sensors(), step_torque(0.0, 400), options);
  EXPECT_GT(made.summary.halved_steps, options.most_halved_steps);
}

TEST(ActuatorChain, ARunOfTooManyStepsPerSampleIsGivenUp) {
  // At least one inner step a sample, which are counted from the 50 000th on.
  SimulationOptions options{.sample_time_s = 0.01, .energy = false, .most_steps_per_sample = 0.5};
  const auto run = [&](std::size_t samples) {
    return simulate(oscillator(1.0, 16.0), coulomb(0.5), hub_sensors(), step_torque(1.0, samples),
                    options);
  };
  EXPECT_NO_THROW(run(20'000));
  EXPECT_THROW(run(60'000), std::runtime_error);
  options.most_steps_per_sample = 100.0;
  EXPECT_NO_THROW(run(60'000));
}

TEST(ActuatorChain, ARunMayHalveAStepForEachSampleItHasPassed) {
  ArmParts parts = coulomb(0.0);
  put(parts, "torque_ripple", {{"amplitude", -2.0}, {"cycles", 3.0}, {"phase", 0.4}});
  // More than one halving per sample from the 178th on.
  const SimulationOptions options{
      .sample_time_s = 0.05, .energy = false, .most_iterations = 4, .most_halved_steps = 0};
  const auto halved_steps = [&](std::size_t samples) {
    return simulate(oscillator(1.0, 0.0), parts, hub_sensors(), step_torque(0.0, samples), options)
        .summary.halved_steps;
  };
  EXPECT_GT(halved_steps(150), 50);
  EXPECT_THROW(halved_steps(200), std::runtime_error);
}

TEST(SensorLag, ReadsThroughAFirstOrderLag) {
  ArmParts parts = coulomb(0.0);
  const double lag = 0.02;
  parts.sensor_chains = {{.sensor = kHubVelocity, .lag_s = lag}};
  const auto made = simulate(oscillator(1.0, 0.0), parts, hub_sensors(), step_torque(1.0, 300),
                             {.sample_time_s = 1e-3});
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double t = made.time_s[k];
    EXPECT_NEAR(made.channels[0][k], 0.5 * t * t, kChainRounding);
    EXPECT_NEAR(made.channels[1][k], t + lag * std::expm1(-t / lag), kChainRounding);
  }
}

}  // namespace
}  // namespace flexarm::response
