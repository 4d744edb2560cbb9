// Coulomb friction against closed forms: turning points, rests, breakaways.
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace flexarm::response {
namespace {

constexpr double kPi = std::numbers::pi;
/// A turning point is a root of a solution that is exact to rounding; its time is a sum of some
/// thousand steps.
constexpr double kTime_s = 1e-11;
/// Rounding of angles of order 1 over some thousand steps.
constexpr double kAngle_rad = 1e-12;

/// A spring-held hub under a step of torque T turns back every half period, each time 2 F/k nearer
/// to T/k, until |T - k theta| <= F.
TEST(HubFriction, CoulombOscillatorTurnsEveryHalfPeriodAndStops) {
  const double inertia = 0.05;
  const double stiffness = 2.0;
  const double friction = 0.1;
  const double torque = 7.3 * friction;
  const auto made = simulate(oscillator(inertia, stiffness), coulomb(friction), hub_sensors(),
                             step_torque(torque, 4001), {.sample_time_s = 1e-3});
  const double half_period = kPi / std::sqrt(stiffness / inertia);
  ASSERT_EQ(made.summary.event_times_s.size(), 5U);  // loose at once, three turns, a stop
  EXPECT_EQ(made.summary.breakaways, 1);
  EXPECT_EQ(made.summary.reversals, 3);
  EXPECT_EQ(made.summary.stops, 1);
  for (int n = 0; n < 5; ++n) {
    EXPECT_NEAR(made.summary.event_times_s[static_cast<std::size_t>(n)], n * half_period, kTime_s);
  }
  EXPECT_NEAR(made.channels[0].back(), 8.0 * friction / stiffness, kAngle_rad);
  // Each swing is 2 F/k shorter than the last, the first one 2 (T - F)/k.
  const double way = 2.0 * (4.0 * torque - (1.0 + 3.0 + 5.0 + 7.0) * friction) / stiffness;
  EXPECT_NEAR(made.energy.dry_friction_J, friction * way, kAngle_rad);
}

TEST(HubFriction, TurningPointsOfADampedOscillatorAreHalfADampedPeriodApart) {
  const double inertia = 0.05;
  const double stiffness = 2.0;
  const double damping = 0.03;
  const auto made = simulate(oscillator(inertia, stiffness, damping), coulomb(0.004), hub_sensors(),
                             step_torque(0.7, 3001), {.sample_time_s = 2e-3});
  const double decay = damping / (2.0 * inertia);
  const double half_period = kPi / std::sqrt(stiffness / inertia - decay * decay);
  const auto& times = made.summary.event_times_s;
  ASSERT_GT(times.size(), 5U);
  for (std::size_t n = 0; n < times.size(); ++n) {
    EXPECT_NEAR(times[n], static_cast<double>(n) * half_period, kTime_s);
  }
}

TEST(HubFriction, AHubAtRestIsAtRestToTheBit) {
  const auto made = simulate(two_masses(0.02, 0.05, 3.0), coulomb(0.1), hub_sensors(),
                             step_torque(0.0999, 1001), {});
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    EXPECT_EQ(made.channels[0][k], 0.0);
    EXPECT_EQ(made.channels[1][k], 0.0);
  }
  EXPECT_EQ(made.summary.breakaways, 0);
  EXPECT_DOUBLE_EQ(made.summary.stick_time_s, made.time_s.back());
}

TEST(HubFriction, ARestInTheMiddleDoesNotCreep) {
  std::vector<double> torque = step_torque(0.3, 200);
  torque.resize(5000, 0.02);
  const auto made = simulate(two_masses(0.02, 0.05, 3.0), coulomb(0.1), hub_sensors(), torque, {});
  ASSERT_GT(made.summary.stops, 0);
  const double last_event = made.summary.event_times_s.back();
  int at_rest = 0;
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    if (made.time_s[k] <= last_event) continue;
    ++at_rest;
    EXPECT_EQ(made.channels[0][k], made.channels[0].back());
    EXPECT_EQ(made.channels[1][k], 0.0);
  }
  EXPECT_GT(at_rest, 1000);
}

/// A ramp r t pulls the hub loose at t = F/r; then theta = (r/k)(s - sin(w s)/w), whose velocity
/// touches zero every period: at its own minimum, where R = F and still growing, so that the hub
/// goes on.
TEST(HubFriction, ARampPullsTheHubLooseAtTheTorqueOfFriction) {
  const double inertia = 0.05;
  const double stiffness = 2.0;
  const double friction = 0.1;
  const double rate = 0.317;
  const double h = 1e-3;
  std::vector<double> torque;
  for (int k = 0; k < 1400; ++k) torque.push_back(rate * h * k);
  const auto made = simulate(oscillator(inertia, stiffness), coulomb(friction), hub_sensors(),
                             torque, {.sample_time_s = h, .hold = TorqueHold::first});
  const double omega = std::sqrt(stiffness / inertia);
  ASSERT_GE(made.summary.event_times_s.size(), 1U);
  EXPECT_NEAR(made.summary.event_times_s[0], friction / rate, kTime_s);
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double s = std::max(0.0, made.time_s[k] - friction / rate);
    EXPECT_NEAR(made.channels[0][k], rate / stiffness * (s - std::sin(omega * s) / omega), 1e-11);
  }
}

/// The same with the breakaway at a sample exactly: one breakaway, not two.
TEST(HubFriction, ABreakawayAtASampleIsOne) {
  std::vector<double> torque;
  for (int k = 0; k < 64; ++k) torque.push_back(k / 64.0);
  const auto made = simulate(oscillator(0.05, 0.0), coulomb(0.25), hub_sensors(), torque,
                             {.sample_time_s = 0x1p-10, .hold = TorqueHold::first});
  EXPECT_EQ(made.summary.breakaways, 1);
  ASSERT_EQ(made.summary.event_times_s.size(), 1U);
  EXPECT_NEAR(made.summary.event_times_s[0], 0x1p-6, kTime_s);
}

/// A torque of just the size of friction holds, a bit more does not.
TEST(HubFriction, HoldsAgainstTorqueUpToItsSize) {
  const double friction = 0.1;
  const auto moved = [&](double torque) {
    const auto made = simulate(two_masses(0.01, 0.05, 3.0), coulomb(friction), hub_sensors(),
                               step_torque(torque, 100), {});
    return made.channels[0].back() != 0.0;
  };
  EXPECT_FALSE(moved(friction));
  EXPECT_FALSE(moved(-friction));
  EXPECT_TRUE(moved(std::nextafter(friction, 1.0)));
  EXPECT_TRUE(moved(-std::nextafter(friction, 1.0)));
}

/// Torque that rises to just the size of friction, at a sample, and falls again.
TEST(HubFriction, ATorqueThatJustTouchesTheSizeOfFrictionMovesNothing) {
  std::vector<double> torque;
  for (int k = 0; k < 64; ++k) torque.push_back((32 - std::abs(k - 32)) / 64.0);
  const auto made = simulate(two_masses(0.01, 0.05, 3.0), coulomb(0.5), hub_sensors(), torque,
                             {.sample_time_s = 0x1p-10, .hold = TorqueHold::first});
  EXPECT_EQ(made.summary.forced_rests, 0);
  EXPECT_LT(std::abs(made.channels[0].back()), 1e-20);
  EXPECT_EQ(made.channels[1].back(), 0.0);
}

/// Torque that flips to and fro faster than the hub turns: events at samples, none forced.
TEST(HubFriction, ATorqueThatFlipsEverySampleLosesNoEnergyBalance) {
  std::vector<double> torque;
  for (int k = 0; k < 2000; ++k) torque.push_back(k % 2 == 0 ? 0.3 : -0.3);
  const auto made = simulate(two_masses(0.01, 0.05, 3.0), coulomb(0.1), hub_sensors(), torque,
                             {.sample_time_s = 1e-3});
  EXPECT_EQ(made.summary.forced_rests, 0);
  EXPECT_GT(made.summary.reversals + made.summary.stops, 1000);
  EXPECT_LT(made.energy.largest_residual_J, 1e-11 * made.energy.work_in_J);
  EXPECT_GE(made.energy.lowest_loss_J, 0.0);
}

/// Closed form of two masses with a hub that sticks and slips, from event to event.
class TwoMasses {
 public:
  TwoMasses(double hub, double wheel, double stiffness, double friction)
      : hub_(hub), wheel_(wheel), stiffness_(stiffness), friction_(friction) {}

  /// Hub and wheel after `s` of turning with friction against `sign`.
  void turn(long double torque, long double sign, long double s) {
    const long double total = hub_ + wheel_;
    const long double net = torque - sign * friction_;
    const long double w = sqrtl(stiffness_ * total / (hub_ * wheel_));
    // Twist u = wheel - hub: u'' = -w^2 u - net/hub. Centre: total x'' = net.
    const long double rest = -net / (hub_ * w * w);
    const long double u = rest + (twist - rest) * cosl(w * s) + twist_rate / w * sinl(w * s);
    const long double ut = -(twist - rest) * w * sinl(w * s) + twist_rate * cosl(w * s);
    const long double centre = angle + twist * wheel_ / total;
    const long double centre_rate = rate + twist_rate * wheel_ / total;
    const long double x = centre + centre_rate * s + net / total * s * s / 2.0L;
    const long double xt = centre_rate + net / total * s;
    angle = x - u * wheel_ / total;
    rate = xt - ut * wheel_ / total;
    twist = u;
    twist_rate = ut;
  }

  void rest(long double s) {
    const long double w = sqrtl(stiffness_ / wheel_);
    const long double u = twist * cosl(w * s) + twist_rate / w * sinl(w * s);
    twist_rate = -twist * w * sinl(w * s) + twist_rate * cosl(w * s);
    twist = u;
    rate = 0.0L;
  }

  long double reaction(long double torque) const { return torque + stiffness_ * twist; }

  long double angle = 0.0L;
  long double rate = 0.0L;
  long double twist = 0.0L;
  long double twist_rate = 0.0L;

 private:
  long double hub_;
  long double wheel_;
  long double stiffness_;
  long double friction_;
};

/// The first s where `value` of the moved copy changes its sign, by small strides and bisection.
template <class Move, class Value>
long double first_change(const TwoMasses& from, const Move& move, const Value& value) {
  const long double stride = 1e-4L;
  const auto at = [&](long double s) {
    TwoMasses copy = from;
    move(copy, s);
    return value(copy);
  };
  long double a = stride;
  const bool positive = at(a) > 0.0L;
  while ((at(a + stride) > 0.0L) == positive) a += stride;
  long double b = a + stride;
  for (int i = 0; i < 70; ++i) {
    const long double m = 0.5L * (a + b);
    ((at(m) > 0.0L) == positive ? a : b) = m;
  }
  return a;
}

/// The torque is dropped while the hub turns: it slows down, stops, is torn loose again by the
/// wheel, and so on.
TEST(HubFriction, StickAndSlipOfTwoMassesFollowTheClosedForm) {
  const double friction = 0.1;
  const double torque = 0.5;
  std::vector<double> samples = step_torque(torque, 100);
  samples.resize(4000, 0.0);
  const auto made = simulate(two_masses(0.01, 0.05, 3.0), coulomb(friction), hub_sensors(), samples,
                             {.sample_time_s = 1e-3});
  TwoMasses exact(0.01, 0.05, 3.0, friction);
  exact.turn(torque, 1.0L, 0.1L);
  ASSERT_GT(exact.rate, 0.0L);
  long double time = 0.1L;
  long double sign = 1.0L;
  bool held = false;
  const auto& times = made.summary.event_times_s;
  ASSERT_GT(times.size(), 4U);
  ASSERT_GT(made.summary.stops, 1);
  ASSERT_GT(made.summary.breakaways, 1);
  for (std::size_t n = 1; n < times.size(); ++n) {
    long double s = 0.0L;
    if (held) {
      s = first_change(
          exact, [](TwoMasses& arm, long double dt) { arm.rest(dt); },
          [&](const TwoMasses& arm) { return friction - fabsl(arm.reaction(0.0L)); });
      exact.rest(s);
      sign = exact.reaction(0.0L) > 0.0L ? 1.0L : -1.0L;
      held = false;
    } else {
      s = first_change(
          exact, [&](TwoMasses& arm, long double dt) { arm.turn(0.0L, sign, dt); },
          [](const TwoMasses& arm) { return arm.rate; });
      exact.turn(0.0L, sign, s);
      held = fabsl(exact.reaction(0.0L)) <= friction;
      if (!held) sign = -sign;
    }
    time += s;
    EXPECT_NEAR(times[n], static_cast<double>(time), 1e-10) << "event " << n;
  }
}

}  // namespace
}  // namespace flexarm::response
