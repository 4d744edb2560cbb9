// What causes outside the library do in the simulator.
#include "tests/trials/companions.hpp"
#include "tests/trials/dirt.hpp"
#include "tests/trials/element_model.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/frequency_simulation.hpp"
#include "tests/trials/time_simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::trials {
namespace {

constexpr std::size_t kOutsideRun = 1000;
constexpr std::size_t kHubAngle = 0;
constexpr std::size_t kHubVelocity = 1;
constexpr std::size_t kTipAcceleration = 2;
constexpr std::size_t kGaugeStrain = 3;

using Channels = std::vector<std::vector<double>>;

const TrialArm& aluminium() {
  return trial_arms().front();
}

std::vector<double> short_torque() {
  Random random(8, "outside");
  std::vector<double> torque = random_torque(2.0 * aluminium().low_torque_N_m, random);
  torque.resize(kOutsideRun);
  return torque;
}

World with_cause(const std::string& name, const Parameters& parameters, double payload_kg = 0.0) {
  World world{aluminium().arm, {{name, parameters}}};
  world.arm.payload.mass_kg = payload_kg;
  return world;
}

Channels readings(const World& world) {
  return simulate_in_time(world, planned_sensors(), short_torque());
}

Channels nominal(double payload_kg = 0.0) {
  World world{aluminium().arm};
  world.arm.payload.mass_kg = payload_kg;
  return readings(world);
}

/// Root mean square of the difference over that of the first.
double difference(const std::vector<double>& one, const std::vector<double>& other) {
  double squares = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    squares += std::pow(one[k] - other[k], 2);
    all += one[k] * one[k];
  }
  return std::sqrt(squares / all);
}

TEST(OutsideCause, EveryOneShowsAtItsLargest) {
  const Channels clean = nominal(0.05);
  for (const Cause& cause : causes()) {
    if (!cause.outside) continue;
    World world = with_hidden(World{aluminium().arm}, aluminium(), cause, cause.largest, Chance{});
    world.arm.payload.mass_kg = 0.05;
    const Channels made = readings(world);
    double largest = 0.0;
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_TRUE(std::ranges::all_of(made[i], [](double v) { return std::isfinite(v); }))
          << cause.name;
      largest = std::max(largest, difference(made[i], clean[i]));
    }
    EXPECT_GT(largest, 0.05) << cause.name;
  }
}

TEST(OutsideCause, NoneOfSizeNearZeroIsSeen) {
  const Channels clean = nominal(0.05);
  for (const char* name : {"stop_impact", "softening_beam", "tapered_beam", "cross_talk"}) {
    const Cause& cause = find_cause(name);
    World world = with_hidden(World{aluminium().arm}, aluminium(), cause,
                              cause.smallest_part * cause.largest, Chance{});
    world.arm.payload.mass_kg = 0.05;
    const Channels made = readings(world);
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_LT(difference(made[i], clean[i]), 1e-3) << name << " " << i;
    }
  }
}

TEST(OutsideCause, AStopHoldsTheHub) {
  const Channels free = nominal();
  const double reach =
      std::ranges::max(free[kHubAngle], {}, [](double angle) { return std::abs(angle); });
  const double stop = 0.3 * std::abs(reach);
  const double inertia = NaturalSizes(aluminium()).inertia_kg_m2;
  const double stiffness = inertia * 1e4;
  const Channels made = readings(
      with_cause("stop_impact", {{"angle", stop}, {"stiffness", stiffness}, {"damping", 0.1}}));
  double largest = 0.0;
  for (const double angle : made[kHubAngle]) largest = std::max(largest, std::abs(angle));
  EXPECT_GT(largest, stop);
  EXPECT_LT(largest, 2.0 * stop);
}

TEST(OutsideCause, WithoutAGapTheRotorTurnsWithTheHub) {
  // Flanks of 150 Hz are stiff for a torque of 1 Hz alone.
  std::vector<double> slow;
  for (std::size_t k = 0; k < kOutsideRun; ++k) {
    const double time_s = static_cast<double>(k) * kSampleTime_s;
    slow.push_back(2.0 * aluminium().low_torque_N_m * std::sin(2.0 * std::numbers::pi * time_s));
  }
  const auto angle = [&](const World& world) {
    return simulate_in_time(world, planned_sensors(), slow)[kHubAngle];
  };
  const std::vector<double> clean = angle(World{aluminium().arm});
  EXPECT_LT(difference(clean, angle(with_cause("backlash", {{"gap", 0.0}}))), 0.02);
  // A gap shows under a torque that shakes.
  const Channels tight = readings(with_cause("backlash", {{"gap", 0.0}}));
  const Channels loose = readings(with_cause("backlash", {{"gap", 0.05}}));
  EXPECT_GT(difference(tight[kHubAngle], loose[kHubAngle]), 0.05);
}

TEST(OutsideCause, CrossTalkAddsOneSensorToAnother) {
  const Channels clean = nominal();
  const Channels made = readings(with_cause("cross_talk", {{"factor", 2e-5}}));
  EXPECT_EQ(made[kTipAcceleration], clean[kTipAcceleration]);
  for (std::size_t k = 0; k < kOutsideRun; ++k) {
    ASSERT_EQ(made[kGaugeStrain][k], clean[kGaugeStrain][k] + 2e-5 * clean[kTipAcceleration][k]);
  }
}

TEST(OutsideCause, ABaseThatTurnsIsSeenAtTheHubAlone) {
  const Channels clean = nominal();
  const Channels made = readings(
      with_cause("moving_base", {{"inertia", 0.05}, {"stiffness", 50.0}, {"damping", 0.05}}));
  EXPECT_EQ(made[kTipAcceleration], clean[kTipAcceleration]);
  EXPECT_EQ(made[kGaugeStrain], clean[kGaugeStrain]);
  EXPECT_GT(difference(clean[kHubVelocity], made[kHubVelocity]), 0.01);
}

TEST(OutsideCause, ABaseUnderAConstantTorqueRingsAboutItsRest) {
  const TrueArm::TurningBase of{0.02, 20.0, 0.01};
  MovedBase base(of);
  const double omega = std::sqrt(of.stiffness_N_m_per_rad / of.inertia_kg_m2);
  const double step_s = 1e-5;
  const int half_period = static_cast<int>(std::lround(std::numbers::pi / omega / step_s));
  for (int k = 0; k < half_period; ++k) base.step(0.5, step_s);
  // The first overshoot: 1 + exp(-zeta pi).
  const double ratio = of.damping_N_m_s_per_rad / (2.0 * of.inertia_kg_m2 * omega);
  const double expected =
      0.5 / of.stiffness_N_m_per_rad * (1.0 + std::exp(-std::numbers::pi * ratio));
  EXPECT_NEAR(base.motion(arm::SensorKind::hub_angle), expected, 1e-3 * expected);
  EXPECT_EQ(base.motion(arm::SensorKind::tip_acceleration), 0.0);
}

TEST(OutsideCause, AClampThatDoesNotSlipHoldsThePayload) {
  const double payload_kg = 0.05;
  const Channels fixed = nominal(payload_kg);
  const Channels held = readings(with_cause("slipping_payload", {{"slip", 1e6}}, payload_kg));
  EXPECT_LT(difference(fixed[kHubAngle], held[kHubAngle]), 0.02);
  const Channels loose = readings(with_cause("slipping_payload", {{"slip", 1e-3}}, payload_kg));
  EXPECT_GT(difference(fixed[kHubAngle], loose[kHubAngle]), 0.05);
  // Without payload there is nothing to slip.
  EXPECT_EQ(readings(with_cause("slipping_payload", {{"slip", 1e-3}})), nominal());
}

TEST(OutsideCause, ATaperedBeamHasItsInertiaAndIsStiffAtItsRoot) {
  TrueArm arm = true_arm(aluminium().arm);
  const double own = arm.hub_inertia_kg_m2;
  const double straight = ElementModel(arm, 20).total_inertia_kg_m2();
  arm.taper = 0.5;
  // int m (1 + a (1/2 - x/l)) x^2 dx = m l^3 (1/3 + a (1/6 - 1/4)).
  const double beam = straight - own;
  EXPECT_NEAR(ElementModel(arm, 20).total_inertia_kg_m2() - own, beam * (1.0 - 3.0 * 0.5 / 12.0),
              1e-9 * beam);
  const auto first_zero = [](double taper) {
    const auto table = poles_and_zeros(with_cause("tapered_beam", {{"taper", taper}}), 1);
    const auto zero =
        std::ranges::find(table, measured::Feature::zero, &measured::ModalEntry::feature);
    return *zero->frequency_Hz;
  };
  // The cantilever: stiffer where it is held, lighter where it moves.
  EXPECT_GT(first_zero(0.5), 1.1 * first_zero(0.0));
  EXPECT_LT(first_zero(-0.5), first_zero(0.0));
}

TEST(OutsideCause, ASofteningBeamBeginsAsItWas) {
  const Channels clean = nominal();
  const Channels made = readings(with_cause("softening_beam", {{"lost", 0.4}}));
  const auto part = [](const std::vector<double>& values, std::size_t from) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(from),
                               values.begin() + static_cast<std::ptrdiff_t>(from + 10));
  };
  EXPECT_LT(difference(part(clean[kGaugeStrain], 0), part(made[kGaugeStrain], 0)), 0.02);
  EXPECT_GT(difference(part(clean[kGaugeStrain], 950), part(made[kGaugeStrain], 950)), 0.1);
}

}  // namespace
}  // namespace flexarm::trials
