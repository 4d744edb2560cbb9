// Lags far shorter than a sample, of the torque and of readings, beside hub friction.
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace flexarm::response {
namespace {

/// Of values of order 1 over some hundred steps.
constexpr double kRounding = 1e-12;
/// A stop is where a speed that is exact to rounding is 0: that rounding over the deceleration.
constexpr double kStopTime_s = 1e-11;
constexpr double kFriction_N_m = 0.23;
constexpr double kSample_s = 1e-2;

/// The hub is driven, coasts to rest within a sample and sticks: its speed v is linear between
/// these times, and through a lag reads v - a lag + (what it was before - v + a lag) e^(-t/lag).
TEST(ShortSensorLag, IsExactBesideFriction) {
  constexpr double kDriven_s = 0.3;
  constexpr double kRest_s = kDriven_s / kFriction_N_m;
  constexpr double kTop = (1.0 - kFriction_N_m) * kDriven_s;
  std::vector<double> torque = step_torque(1.0, 30);
  torque.resize(200, 0.0);
  for (const double lag : {0.3, 1e-2, 5e-3, 1e-4, 1e-7}) {
    ArmParts parts = coulomb(kFriction_N_m);
    parts.sensor_chains = {{.sensor = kHubVelocity, .lag_s = lag}};
    const auto made = simulate(oscillator(1.0, 0.0), parts, hub_sensors(), torque,
                               {.sample_time_s = kSample_s, .energy = false});
    const auto through_lag = [lag](double t, double begin, double v, double a, double read) {
      const double s = t - begin;
      return v + a * s - a * lag + (read - v + a * lag) * std::exp(-s / lag);
    };
    const auto driven = [&](double t) {
      return through_lag(t, 0.0, 0.0, 1.0 - kFriction_N_m, 0.0);
    };
    const auto coasting = [&](double t) {
      return through_lag(t, kDriven_s, kTop, -kFriction_N_m, driven(kDriven_s));
    };
    for (std::size_t k = 0; k < made.time_s.size(); ++k) {
      const double t = made.time_s[k];
      const double expected = k <= 30         ? driven(t)
                              : t <= kRest_s ? coasting(t)
                                             : through_lag(t, kRest_s, 0.0, 0.0, coasting(kRest_s));
      EXPECT_NEAR(made.channels[1][k], expected, kRounding) << "lag " << lag << " s at " << t;
    }
  }
}

TEST(ShortSensorLag, CostsNoSteps) {
  std::vector<double> torque = step_torque(0.3, 200);
  torque.resize(2000, 0.02);
  const auto simulated = [&](double lag) {
    ArmParts parts = coulomb(0.1);
    if (lag > 0.0) parts.sensor_chains = {{.sensor = kHubVelocity, .lag_s = lag}};
    return simulate(two_masses(0.02, 0.05, 3.0), parts, hub_sensors(), torque, {.energy = false});
  };
  const auto at_once = simulated(0.0);
  ASSERT_GT(at_once.summary.stops, 0);
  for (const double lag : {1e-2, 1e-6, 1e-9}) {
    EXPECT_EQ(simulated(lag).summary.inner_steps, at_once.summary.inner_steps) << lag;
  }
}

/// u = 1 + rate t through a lag on a hub of inertia 1.
struct LaggedRamp {
  double lag_s;
  double rate;

  double torque(double t) const {
    return -(1.0 - rate * lag_s) * std::expm1(-t / lag_s) + rate * t;
  }
  /// Integral of the torque from 0.
  double impulse(double t) const {
    return (1.0 - rate * lag_s) * (t + lag_s * std::expm1(-t / lag_s)) + 0.5 * rate * t * t;
  }
  /// When the torque is that of friction.
  double breakaway_s() const {
    double below = 0.0;
    double above = 1.0;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (below + above);
      (torque(middle) < kFriction_N_m ? below : above) = middle;
    }
    return above;
  }
  double speed(double t) const {
    const double begin = breakaway_s();
    if (t < begin) return 0.0;
    return impulse(t) - impulse(begin) - kFriction_N_m * (t - begin);
  }
};

ArmParts lagged_friction(double lag_s) {
  ArmParts parts = coulomb(kFriction_N_m);
  if (lag_s > 0.0) put(parts, "actuator_lag", {{"time_constant", lag_s}});
  return parts;
}

TEST(ShortActuatorLag, IsExactBesideFriction) {
  for (const double rate : {0.0, 0.7, -0.5}) {
    std::vector<double> torque;
    for (int k = 0; k < 100; ++k) torque.push_back(1.0 + rate * kSample_s * k);
    for (const double lag : {0.3, 1e-2, 3e-4, 1e-4, 1e-6, 1e-9}) {
      const auto made = simulate(
          oscillator(1.0, 0.0), lagged_friction(lag), hub_sensors(), torque,
          {.sample_time_s = kSample_s, .hold = TorqueHold::first, .energy = false});
      const LaggedRamp ramp{lag, rate};
      for (std::size_t k = 0; k < made.time_s.size(); ++k) {
        const double t = made.time_s[k];
        EXPECT_NEAR(made.channels[1][k], ramp.speed(t), kRounding) << lag << " s at " << t;
        EXPECT_NEAR(made.hub_torque_N_m[k], ramp.torque(t), kRounding) << lag << " s at " << t;
      }
    }
  }
}

/// The hub stops within a sample, in the part of it that is stepped with a settled torque.
TEST(ShortActuatorLag, AStopAfterItHasSettledIsLocated) {
  constexpr double kDriven_s = 0.3;
  std::vector<double> torque = step_torque(1.0, 30);
  torque.resize(200, 0.0);
  for (const double lag : {1e-3, 1e-4, 1e-7}) {
    const auto made = simulate(oscillator(1.0, 0.0), lagged_friction(lag), hub_sensors(), torque,
                               {.sample_time_s = kSample_s});
    ASSERT_EQ(made.summary.stops, 1);
    ASSERT_EQ(made.summary.event_times_s.size(), 2U);
    // What the lag keeps back of the torque until 0.3 s it gives after that: lag more in all.
    const double breakaway = LaggedRamp{lag, 0.0}.breakaway_s();
    const double impulse = kDriven_s - breakaway - lag * std::exp(-breakaway / lag);
    EXPECT_NEAR(made.summary.event_times_s[0], breakaway, kRounding);
    EXPECT_NEAR(made.summary.event_times_s[1], breakaway + (impulse + lag) / kFriction_N_m,
                kStopTime_s);
  }
}

TEST(ShortActuatorLag, CostsFewSteps) {
  std::vector<double> torque = step_torque(0.3, 200);
  torque.resize(2000, 0.02);
  const auto steps = [&](double lag) {
    return simulate(two_masses(0.02, 0.05, 3.0), lagged_friction(lag), hub_sensors(), torque,
                    {.energy = false})
        .summary.inner_steps;
  };
  // Before it settles, and after.
  EXPECT_LE(steps(1e-9), 3 * steps(0.0));
}

}  // namespace
}  // namespace flexarm::response
