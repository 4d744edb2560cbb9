// A measured law of hub torque in time, against an integration of its own and against effects of
// the library that a table can hold.
#include "arm/given_effects.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

arm::Arm with_table(arm::Arm arm, const arm::HubTorqueTable& table) {
  arm.effects[std::string(arm::kHubTorqueTable)] = {.definition = arm::define_effect(table)};
  return arm;
}

response::Simulation in_time(const arm::Arm& arm, const std::vector<double>& torque,
                             const std::vector<arm::Sensor>& sensors, double sample_time_s) {
  constexpr int kBeamModes = 4;
  const auto parts = response::take_apart(arm);
  const auto model = response::time_model(
      response::make_formulation("exact_tf", parts.linear, kBeamModes), parts, kBeamModes, sensors);
  return response::simulate(model, parts, sensors, torque, {.sample_time_s = sample_time_s});
}

constexpr double kTableHubInertia = 0.01;
constexpr double kTableHubFriction = 0.004;

/// Angle and velocity at each sample by Runge and Kutta's method for J theta'' = tau - c theta' +
/// T(theta, theta'), T given on two axes; the torque is held from sample to sample.
template <class Torque>
std::vector<std::array<double, 2>> integrated(const Torque& law, const std::vector<double>& torque,
                                              double sample_time_s) {
  constexpr int kSteps = 400;
  const double h = sample_time_s / kSteps;
  std::vector<std::array<double, 2>> states;
  double angle = 0.0;
  double speed = 0.0;
  for (const double tau : torque) {
    states.push_back({angle, speed});
    const auto rate = [&](double a, double v) {
      return (tau - kTableHubFriction * v + law(a, v)) / kTableHubInertia;
    };
    for (int i = 0; i < kSteps; ++i) {
      const double v1 = speed;
      const double a1 = rate(angle, speed);
      const double v2 = speed + 0.5 * h * a1;
      const double a2 = rate(angle + 0.5 * h * v1, v2);
      const double v3 = speed + 0.5 * h * a2;
      const double a3 = rate(angle + 0.5 * h * v2, v3);
      const double v4 = speed + h * a3;
      const double a4 = rate(angle + h * v3, v4);
      angle += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
      speed += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
  }
  return states;
}

/// Linear through equally spaced places from -1 to 1, held beyond.
double weight(double x, int place, double spacing) {
  const double at = -1.0 + place * spacing;
  const double held = std::fmin(1.0, std::fmax(-1.0, x));
  return std::fmax(0.0, 1.0 - std::abs(held - at) / spacing);
}

TEST(MeasuredLaw, MovesARigidHubAsAnIntegrationOfTheSameTable) {
  constexpr std::array<std::array<double, 5>, 3> kTorque = {{{0.09, 0.05, 0.03, -0.02, -0.04},
                                                             {0.03, 0.04, 0.00, -0.05, -0.02},
                                                             {0.02, 0.01, -0.03, -0.05, -0.1}}};
  arm::HubTorqueTable table{.angle_rad = {-1.0, 0.0, 1.0},
                            .velocity_rad_per_s = {-1.0, -0.5, 0.0, 0.5, 1.0}};
  for (const auto& row : kTorque) {
    table.torque_N_m.insert(table.torque_N_m.end(), row.begin(), row.end());
  }
  arm::Arm hub;
  hub.hub = {kTableHubInertia, kTableHubFriction};
  const double sample_time_s = 2e-3;
  std::vector<double> torque;
  for (int k = 0; k < 1500; ++k)
    torque.push_back(0.06 * std::sin(0.011 * k) + (k < 300 ? 0.07 : 0.0));

  const auto law = [&](double angle, double speed) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 5; ++j) {
        sum += weight(angle, i, 1.0) * weight(speed, j, 0.5) *
               kTorque[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      }
    }
    return sum;
  };
  const auto reference = integrated(law, torque, sample_time_s);
  const auto made =
      in_time(with_table(hub, table), torque,
              {arm::parse_sensor("hub_angle"), arm::parse_sensor("hub_velocity")}, sample_time_s);
  double largest_angle = 0.0;
  double largest_speed = 0.0;
  // A step over a bend of the table is of order 2: with slopes that change by some 10/s and
  // accelerations of some 10 rad/s^2, 10/s 10 rad/s^2 (2 ms)^2/8 a bend.
  constexpr double kBends = 2e-4;
  for (std::size_t k = 0; k < torque.size(); ++k) {
    largest_angle = std::fmax(largest_angle, std::abs(reference[k][0]));
    largest_speed = std::fmax(largest_speed, std::abs(reference[k][1]));
    ASSERT_NEAR(made.channels[0][k], reference[k][0], kBends) << k;
    ASSERT_NEAR(made.channels[1][k], reference[k][1], kBends) << k;
  }
  // Beyond the ends of both axes, and back.
  EXPECT_GT(largest_angle, 1.0);
  EXPECT_GT(largest_speed, 1.0);
}

std::vector<double> some_pulses() {
  std::vector<double> torque;
  for (int k = 0; k < 400; ++k) torque.push_back(k % 120 < 60 ? 0.15 : -0.12);
  return torque;
}

/// `tolerance` relative to the peaks.
void expect_same_in_time(const arm::Arm& one, const arm::Arm& other, double tolerance) {
  std::vector<arm::Sensor> sensors = {arm::parse_sensor("hub_angle"),
                                      arm::parse_sensor("hub_velocity")};
  if (arm::has_beam(one)) sensors.push_back(arm::parse_sensor("tip_acceleration"));
  const auto ours = in_time(one, some_pulses(), sensors, 2e-3);
  const auto theirs = in_time(other, some_pulses(), sensors, 2e-3);
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    double peak = 0.0;
    for (const double value : theirs.channels[j]) peak = std::fmax(peak, std::abs(value));
    for (std::size_t k = 0; k < theirs.time_s.size(); ++k) {
      ASSERT_NEAR(ours.channels[j][k], theirs.channels[j][k], tolerance * peak) << j << " " << k;
    }
  }
}

/// Of the same modes: by inner steps over which forces vary.
constexpr double kInnerSteps = 1e-7;

TEST(MeasuredLaw, OfADoubleZeroIsDryFriction) {
  arm::Arm library = laws::damped_arm();
  put(library, "coulomb_friction", {{"torque", 0.012}});
  put(library, "torque_bias", {{"torque", 0.003}});
  expect_same_in_time(
      with_table(laws::damped_arm(), {.velocity_rad_per_s = {-1.0, 0.0, 0.0, 1.0},
                                      .torque_N_m = {0.015, 0.015, -0.009, -0.009}}),
      library, kInnerSteps);
}

TEST(MeasuredLaw, OfALineIsViscousFriction) {
  arm::Arm library = laws::damped_arm();
  put(library, "hub_viscous_friction", {{"coefficient", 0.01}});
  expect_same_in_time(with_table(laws::damped_arm(), {.velocity_rad_per_s = {-100.0, 100.0},
                                                      .torque_N_m = {1.0, -1.0}}),
                      library, kInnerSteps);
}

TEST(MeasuredLaw, OfAnAngleIsASpring) {
  // Of a beam, as many modes with a spring hold another part of the motion.
  arm::Arm hub;
  hub.hub = {kTableHubInertia, kTableHubFriction};
  arm::Arm library = hub;
  put(library, "hub_spring", {{"stiffness", 0.6}});
  expect_same_in_time(
      with_table(hub, {.angle_rad = {-100.0, 3.0, 100.0}, .torque_N_m = {60.0, -1.8, -60.0}}),
      library, kInnerSteps);
}

TEST(MeasuredLaw, IsLeftOutOfLinearAnalysesByName) {
  const arm::Arm arm = with_table(laws::damped_arm(),
                                  {.velocity_rad_per_s = {-1.0, 1.0}, .torque_N_m = {0.1, -0.1}});
  EXPECT_THAT(response::nonlinear_effects(arm), testing::ElementsAre("measured_hub_torque"));
  EXPECT_THAT(response::linearised_effects(arm), testing::IsEmpty());
  EXPECT_TRUE(response::take_apart(arm).linear.effects.empty());
}

}  // namespace
}  // namespace flexarm::effects
