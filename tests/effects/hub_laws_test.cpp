// Laws of hub torque on a rigid hub against closed forms, energies and an independent integration.
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"
#include "laws/effect_arms.hpp"
#include "tests/response/simulation_models.hpp"

#include <boost/numeric/odeint.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

constexpr double kHubInertia = 0.02;
constexpr double kHubTorque = 0.05;
constexpr double kHubSample_s = 2e-3;

/// Of some hundred steps of an error of order 4 in the step, each a twentieth and less of the time
/// in which the law's torque changes.
constexpr double kLawOrderFour = 1e-7;

/// Hub angle and velocity of a free rigid hub with that effect.
response::Simulation rigid_hub(const std::string& effect,
                               const std::map<std::string, double>& parameters,
                               const std::vector<double>& torque) {
  response::ArmParts parts;
  parts.linear = arm::paper_arm();
  response::put(parts, effect, parameters);
  return response::simulate(response::oscillator(kHubInertia, 0.0), parts, response::hub_sensors(),
                            torque,
                            {.sample_time_s = kHubSample_s, .substeps = 8, .energy = false});
}

std::vector<double> steady_torque(double torque_N_m) {
  return response::step_torque(torque_N_m, 400);
}

std::vector<double> slow_sine(std::size_t samples) {
  std::vector<double> torque;
  for (std::size_t k = 0; k < samples; ++k) {
    torque.push_back(kHubTorque * std::sin(0.012 * static_cast<double>(k)));
  }
  return torque;
}

/// Work of a constant torque goes into motion and into the law's potential.
template <class Potential>
void expect_energy(const response::Simulation& made, Potential potential_J) {
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double angle = made.channels[0][k];
    const double speed = made.channels[1][k];
    const double work_J = kHubTorque * angle;
    ASSERT_NEAR(0.5 * kHubInertia * speed * speed + potential_J(angle), work_J,
                kLawOrderFour * (kHubTorque + std::abs(work_J)))
        << made.time_s[k];
  }
  EXPECT_GT(std::abs(made.channels[0].back()), 0.1) << "it has moved";
}

TEST(LoadFriction, TakesItsPartOfTheLoadThatIsDriven) {
  // Far above its velocity: the work of the load goes into motion.
  constexpr double kFactor = 0.3;
  expect_energy(rigid_hub("load_friction", {{"factor", kFactor}, {"velocity", 1e-6}},
                          steady_torque(kHubTorque)),
                [](double angle) { return kFactor / (1.0 + kFactor) * kHubTorque * angle; });
}

TEST(LoadFriction, HelpsATorqueThatBrakes) {
  constexpr double kFactor = 0.3;
  std::vector<double> torque(400, kHubTorque);
  std::fill(torque.begin() + 200, torque.end(), -kHubTorque);
  const auto made = rigid_hub("load_friction", {{"factor", kFactor}, {"velocity", 1e-6}}, torque);
  const auto& speed = made.channels[1];
  const double per_sample = kHubTorque / kHubInertia * kHubSample_s;
  EXPECT_NEAR(speed[150] - speed[149], per_sample / (1.0 + kFactor), kLawOrderFour);
  EXPECT_NEAR(speed[251] - speed[250], -per_sample / (1.0 - kFactor), kLawOrderFour);
}

TEST(HubHardeningSpring, StoresTheFourthPowerOfTheAngle) {
  constexpr double kCoefficient = 0.3;
  expect_energy(
      rigid_hub("hub_hardening_spring", {{"coefficient", kCoefficient}}, steady_torque(kHubTorque)),
      [](double angle) { return 0.25 * kCoefficient * std::pow(angle, 4); });
}

TEST(Tilt, StoresTheHeightOfTheCentreOfMass) {
  constexpr double kAmplitude = 0.04;
  constexpr double kAngle = 0.7;
  expect_energy(
      rigid_hub("tilt", {{"amplitude", kAmplitude}, {"angle", kAngle}}, steady_torque(kHubTorque)),
      [](double angle) { return kAmplitude * (std::cos(-kAngle) - std::cos(angle - kAngle)); });
}

TEST(Tilt, LeavesAnArmAtRestWhereItHangs) {
  const auto made = rigid_hub("tilt", {{"amplitude", 0.04}, {"angle", 0.0}}, steady_torque(0.0));
  EXPECT_EQ(std::ranges::max(made.channels[0]), 0.0);
}

TEST(DisturbanceTorque, IsASineOfTime) {
  constexpr double kAmplitude = 0.03;
  constexpr double kFrequency_Hz = 6.0;
  constexpr double kPhase = 0.4;
  const auto made =
      rigid_hub("disturbance_torque",
                {{"amplitude", kAmplitude}, {"frequency", kFrequency_Hz}, {"phase", kPhase}},
                steady_torque(kHubTorque));
  const double omega = 2.0 * std::numbers::pi * kFrequency_Hz;
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double t = made.time_s[k];
    const double expected =
        (kHubTorque * t + kAmplitude / omega * (std::cos(kPhase) - std::cos(omega * t + kPhase))) /
        kHubInertia;
    ASSERT_NEAR(made.channels[1][k], expected, kLawOrderFour) << t;
  }
}

TEST(FrictionAsymmetry, BrakesOneWayAndDrivesTheOther) {
  constexpr double kCoefficient = 0.03;
  const auto forward =
      rigid_hub("friction_asymmetry", {{"coefficient", kCoefficient}}, steady_torque(kHubTorque));
  const auto backward =
      rigid_hub("friction_asymmetry", {{"coefficient", kCoefficient}}, steady_torque(-kHubTorque));
  const double rate = kCoefficient / kHubInertia;
  for (std::size_t k = 0; k < forward.time_s.size(); ++k) {
    const double t = forward.time_s[k];
    const double braked = -kHubTorque / kCoefficient * std::expm1(-rate * t);
    const double driven = -kHubTorque / kCoefficient * std::expm1(rate * t);
    ASSERT_NEAR(forward.channels[1][k], braked, kLawOrderFour) << t;
    ASSERT_NEAR(backward.channels[1][k], driven, kLawOrderFour * (1.0 + std::abs(driven))) << t;
  }
}

TEST(FrictionAsymmetry, BesideViscousFrictionIsAnotherCoefficientEachWay) {
  constexpr double kMean = 0.02;
  constexpr double kDifference = 0.015;
  for (const double sign : {1.0, -1.0}) {
    response::ArmParts parts;
    parts.linear = arm::paper_arm();
    response::put(parts, "friction_asymmetry", {{"coefficient", kDifference}});
    const auto made = response::simulate(response::oscillator(kHubInertia, 0.0, kMean), parts,
                                         response::hub_sensors(), steady_torque(sign * kHubTorque),
                                         {.sample_time_s = kHubSample_s, .energy = false});
    const double coefficient = kMean + sign * kDifference;
    const double t = made.time_s.back();
    EXPECT_NEAR(made.channels[1].back(),
                -sign * kHubTorque / coefficient * std::expm1(-coefficient / kHubInertia * t),
                kLawOrderFour);
  }
}

TEST(BackEmf, IsTheDampingOfViscousFriction) {
  arm::Arm by_voltage = laws::damped_arm();
  put(by_voltage, "back_emf", {{"constant", 0.013}});
  arm::Arm by_friction = laws::damped_arm();
  put(by_friction, "hub_viscous_friction", {{"coefficient", 0.013}});
  EXPECT_EQ(arm::linear_arm(by_voltage), arm::linear_arm(by_friction));
  put(by_voltage, "hub_viscous_friction", {{"coefficient", 0.002}});
  EXPECT_NEAR(arm::linear_arm(by_voltage).hub_viscous_friction_N_m_s_per_rad,
              laws::damped_arm().hub.viscous_friction_N_m_s_per_rad + 0.015, 1e-16);
}

constexpr double kDahlTorque = 0.02;
constexpr double kDahlStiffness = 0.5;

/// While the hub turns one way the friction is torque (1 - e^(-stiffness angle/torque)).
TEST(HubHysteresis, TakesTheWorkOfItsCurveWhileTheHubTurnsOneWay) {
  expect_energy(
      rigid_hub("hub_hysteresis", {{"torque", kDahlTorque}, {"stiffness", kDahlStiffness}},
                steady_torque(kHubTorque)),
      [](double angle) {
        return kDahlTorque * (angle + kDahlTorque / kDahlStiffness *
                                          std::expm1(-kDahlStiffness / kDahlTorque * angle));
      });
}

/// Dahl's equation in the friction torque itself, with an adaptive Runge-Kutta method.
std::vector<double> integrated_angle(const std::vector<double>& torque) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, 3>;  // angle, velocity, friction
  constexpr double kTolerance = 1e-11;
  State x = {0.0, 0.0, 0.0};
  std::vector<double> angle;
  for (const double command : torque) {
    angle.push_back(x[0]);
    const auto rates = [command](const State& at, State& rate, double /*t*/) {
      const double sign = at[1] < 0.0 ? -1.0 : 1.0;
      rate[0] = at[1];
      rate[1] = (command - at[2]) / kHubInertia;
      rate[2] = kDahlStiffness * (1.0 - sign * at[2] / kDahlTorque) * at[1];
    };
    odeint::integrate_adaptive(
        odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(kTolerance, kTolerance), rates,
        x, 0.0, kHubSample_s, 0.1 * kHubSample_s);
  }
  return angle;
}

TEST(HubHysteresis, FollowsDahlsEquationThroughReversals) {
  // Where the speed changes its sign within a step the law has a corner: order 2 there.
  constexpr double kCorners = 1e-5;
  const auto torque = slow_sine(1500);
  const auto made =
      rigid_hub("hub_hysteresis", {{"torque", kDahlTorque}, {"stiffness", kDahlStiffness}}, torque);
  const std::vector<double> expected = integrated_angle(torque);
  const double size = std::ranges::max(expected);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_NEAR(made.channels[0][k], expected[k], kCorners * size) << made.time_s[k];
  }
  const auto& speed = made.channels[1];
  EXPECT_LT(std::ranges::min(speed), 0.0);
  EXPECT_GT(std::ranges::max(speed), 0.0);
}

/// The state after a turn is what its rates come to on the way.
TEST(HubHysteresis, MovesItsStateByTheTurnAlone) {
  constexpr int kParts = 4000;
  constexpr double kOfEuler = 1e-3;  // first order, over 16 times the angle of presliding
  const arm::Effect law =
      effect("hub_hysteresis", {{"torque", kDahlTorque}, {"stiffness", kDahlStiffness}});
  const auto friction = std::get<arm::SmoothHubTorque>(law.definition->hub_torque(law));
  for (const double turn :
       {2.0 * kDahlTorque / kDahlStiffness, -0.5 * kDahlTorque / kDahlStiffness}) {
    for (const double begin : {0.0, -1.0, 0.6}) {
      std::array<double, 1> after = {};
      friction.after_turn(turn, std::array{begin}, after);
      // At any speed.
      for (const double speed : {0.01, 3.0}) {
        const double velocity = std::copysign(speed, turn);
        const double step_s = turn / velocity / kParts;
        double z = begin;
        for (int i = 0; i < kParts; ++i) {
          std::array<double, 1> rate = {};
          friction.law({.velocity_rad_per_s = velocity}, std::array{z}, rate);
          z += step_s * rate[0];
        }
        EXPECT_NEAR(z, after[0], kOfEuler) << turn << " from " << begin;
      }
    }
  }
}

TEST(HubHysteresis, BecomesCoulombFrictionAsItsStiffnessGrows) {
  const auto torque = slow_sine(1000);
  const auto limit = rigid_hub("coulomb_friction", {{"torque", kDahlTorque}}, torque);
  const auto distance = [&](double stiffness) {
    const auto made =
        rigid_hub("hub_hysteresis", {{"torque", kDahlTorque}, {"stiffness", stiffness}}, torque);
    double largest = 0.0;
    for (std::size_t k = 0; k < torque.size(); ++k) {
      largest = std::max(largest, std::abs(made.channels[0][k] - limit.channels[0][k]));
    }
    return largest;
  };
  // A hub that comes to rest swings on: its speed falls as 1/sqrt(stiffness).
  const double soft = distance(2.0);
  const double stiff = distance(150.0);
  EXPECT_LT(stiff, 0.2 * soft);
  EXPECT_GT(soft, 1e-3);
}

}  // namespace
}  // namespace flexarm::effects
