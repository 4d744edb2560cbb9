// Drag and speed-dependent friction: closed forms, and the order of the method.
#include "response/time/beam_forces.hpp"

#include "arm/input_error.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace flexarm::response {
namespace {

constexpr double kLength_m = 0.96;

/// The rigid arm, y = x theta, with what drag asks for.
arm::ModalModel rigid_arm(double inertia) {
  arm::ModalModel model = oscillator(inertia, 0.0);
  model.modes[0].displacement_m = beam_stations(kLength_m).stations_m;
  return model;
}

ArmParts with_drag(double coefficient) {
  ArmParts parts = coulomb(0.0);
  put(parts, "quadratic_drag", {{"coefficient", coefficient}});
  return parts;
}

TEST(DragStations, IntegrateWhatDragOfARigidArmNeeds) {
  const BeamStations rule = beam_stations(kLength_m);
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.stations_m.size(); ++k) {
    sum += rule.weights_m[k] * std::pow(rule.stations_m[k], 3);
    EXPECT_GT(rule.stations_m[k], k == 0 ? 0.0 : rule.stations_m[k - 1]);
  }
  EXPECT_LT(rule.stations_m.back(), kLength_m);
  EXPECT_NEAR(sum, std::pow(kLength_m, 4) / 4.0, 1e-15);
}

/// I v' = T - k v^2 with k = c l^4/4: v = sqrt(T/k) tanh(sqrt(T k) t/I).
double largest_error_of_terminal_speed(int substeps) {
  const double inertia = 0.05;
  const double coefficient = 0.4;
  const double torque = 0.3;
  const auto made =
      simulate(rigid_arm(inertia), with_drag(coefficient), hub_sensors(), step_torque(torque, 41),
               {.sample_time_s = 0.05, .substeps = substeps});
  const double k = coefficient * std::pow(kLength_m, 4) / 4.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < made.time_s.size(); ++i) {
    const double exact =
        std::sqrt(torque / k) * std::tanh(std::sqrt(torque * k) / inertia * made.time_s[i]);
    worst = std::max(worst, std::abs(made.channels[1][i] - exact) / std::sqrt(torque / k));
  }
  return worst;
}

double slope(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(QuadraticDrag, ARigidArmReachesItsTerminalSpeedAtOrderFour) {
  const std::array errors = {largest_error_of_terminal_speed(2), largest_error_of_terminal_speed(4),
                             largest_error_of_terminal_speed(8),
                             largest_error_of_terminal_speed(16)};
  EXPECT_LT(errors.back(), 1e-8);
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_NEAR(slope(errors[i - 1], errors[i]), 4.0, 0.15) << errors[i];
  }
}

TEST(QuadraticDrag, AModelWithoutDisplacementsIsRefused) {
  EXPECT_THROW(simulate(oscillator(1.0, 0.0), with_drag(0.1), hub_sensors(), step_torque(1.0, 3)),
               arm::InputError);
}

/// Two masses that stick and slip with Stribeck friction, at several inner steps.
Simulation stribeck_run(int substeps) {
  ArmParts parts = coulomb(0.01);
  put(parts, "stribeck_friction", {{"torque", 0.05}, {"static_torque", 0.09}, {"velocity", 0.5}});
  std::vector<double> torque;
  for (int k = 0; k < 60; ++k) torque.push_back(0.16 * std::sin(0.48 * k));
  return simulate(two_masses(0.01, 0.05, 3.0), parts, hub_sensors(), torque,
                  {.sample_time_s = 0.04, .hold = TorqueHold::first, .substeps = substeps});
}

TEST(StribeckFriction, ConvergesAtOrderFourThroughRestsAndBreakaways) {
  const Simulation reference = stribeck_run(128);
  ASSERT_GT(reference.summary.stops, 1);
  ASSERT_GT(reference.summary.breakaways, 1);
  std::vector<double> errors;
  for (const int substeps : {2, 4, 8, 16}) {
    const Simulation made = stribeck_run(substeps);
    EXPECT_EQ(made.summary.stops, reference.summary.stops);
    double worst = 0.0;
    for (std::size_t k = 0; k < made.time_s.size(); ++k) {
      worst = std::max(worst, std::abs(made.channels[0][k] - reference.channels[0][k]));
    }
    errors.push_back(worst);
  }
  EXPECT_LT(errors[0], 1e-4);
  // Fitted over three halvings; a single one scatters, since each run cuts its steps elsewhere.
  EXPECT_NEAR(slope(errors.front(), errors.back()) / 3.0, 4.0, 0.5)
      << errors[0] << ' ' << errors[1] << ' ' << errors[2] << ' ' << errors[3];
}

TEST(StribeckFriction, BreaksAwayAtItsStaticTorque) {
  ArmParts parts = coulomb(0.0);
  put(parts, "stribeck_friction", {{"torque", 0.05}, {"static_torque", 0.09}, {"velocity", 0.5}});
  const double rate = 0.1;
  std::vector<double> torque;
  for (int k = 0; k < 1000; ++k) torque.push_back(rate * 1e-3 * k);
  const auto made = simulate(oscillator(0.05, 0.0), parts, hub_sensors(), torque,
                             {.sample_time_s = 1e-3, .hold = TorqueHold::first});
  ASSERT_EQ(made.summary.event_times_s.size(), 1U);
  EXPECT_NEAR(made.summary.event_times_s[0], 0.9, 1e-12);
}

}  // namespace
}  // namespace flexarm::response
