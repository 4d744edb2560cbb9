// Inverse dynamics of the hub beside closed forms, and the torque that reaches it.
#include "response/time/torque_for_motion.hpp"

#include "arm/input_error.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace flexarm::response {
namespace {

constexpr double kTurn_rad = 0.3;
constexpr double kMotion_rad_per_s = 5.0;
constexpr double kDuration_s = 2.0;

/// Returns the accelerations of theta = A sin(w t).
std::vector<double> sine_accelerations(double step_s) {
  std::vector<double> made;
  for (double t = 0.0; t <= kDuration_s; t += step_s) {
    made.push_back(-kTurn_rad * kMotion_rad_per_s * kMotion_rad_per_s *
                   std::sin(kMotion_rad_per_s * t));
  }
  return made;
}

/// Returns the model without sensors.
arm::ModalModel unread(arm::ModalModel model) {
  for (auto& mode : model.modes) mode.sensor_values.clear();
  return model;
}

template <class Torque>
double largest_error_N_m(const arm::ModalModel& model, double step_s, Torque exact) {
  const auto made = torque_for_motion(unread(model), {}, 0.0, kTurn_rad * kMotion_rad_per_s,
                                      sine_accelerations(step_s), step_s);
  double largest = 0.0;
  for (std::size_t k = 0; k < made.torque_N_m.size(); ++k) {
    const double error = made.torque_N_m[k] - exact(static_cast<double>(k) * step_s);
    largest = std::max(largest, std::abs(error));
  }
  return largest;
}

/// Accelerations are taken for linear between samples: an error of order 2.
template <class Torque>
void expect_second_order(const arm::ModalModel& model, Torque exact) {
  constexpr double kCoarse_s = 0.004;
  const double coarse = largest_error_N_m(model, kCoarse_s, exact);
  const double fine = largest_error_N_m(model, kCoarse_s / 2.0, exact);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

TEST(TorqueForMotion, OfAnOscillator) {
  constexpr double kInertia = 2.0;
  constexpr double kDamping = 0.7;
  constexpr double kStiffness = 30.0;
  expect_second_order(oscillator(kInertia, kStiffness, kDamping), [](double t) {
    const double w = kMotion_rad_per_s;
    return kTurn_rad *
           ((kStiffness - kInertia * w * w) * std::sin(w * t) + kDamping * w * std::cos(w * t));
  });
}

TEST(TorqueForMotion, HasTheReactionOfWhatTheHubCarries) {
  constexpr double kHub = 2.0;
  constexpr double kWheel = 1.0;
  constexpr double kStiffness = 200.0;
  expect_second_order(two_masses(kHub, kWheel, kStiffness), [](double t) {
    // The wheel follows a hub that moves: J phi'' = k (theta - phi), phi' = theta' at the start.
    const double w = kMotion_rad_per_s;
    const double own = std::sqrt(kStiffness / kWheel);
    const double forced = kTurn_rad * kStiffness / (kStiffness - kWheel * w * w);
    const double theta = kTurn_rad * std::sin(w * t);
    const double phi =
        forced * std::sin(w * t) + (kTurn_rad - forced) * w / own * std::sin(own * t);
    return -kHub * w * w * theta + kStiffness * (theta - phi);
  });
}

TEST(TorqueForMotion, RefusesForcesAlongTheBeam) {
  ArmParts parts;
  parts.beam_forces.push_back({"quadratic_drag", {}});
  EXPECT_THROW(
      torque_for_motion(unread(oscillator(1.0, 0.0)), parts, 0.0, 0.0, std::vector{0.0, 1.0}, 0.1),
      arm::InputError);
}

TEST(TransmittedTorque, IsTheMeanOverEachInterval) {
  const std::vector<double> torque = {1.0, 3.0, 3.0};
  EXPECT_EQ(transmitted_torque_N_m({}, torque, 0.1, TorqueHold::zero), torque);
  EXPECT_EQ(transmitted_torque_N_m({}, torque, 0.1, TorqueHold::first),
            (std::vector{2.0, 3.0, 3.0}));
  // Late by a quarter of the interval.
  const auto late = transmitted_torque_N_m({.delay_s = 0.025}, torque, 0.1, TorqueHold::zero);
  EXPECT_NEAR(late[0], 0.75, 1e-12);
  EXPECT_NEAR(late[1], 0.25 * 1.0 + 0.75 * 3.0, 1e-12);
}

TEST(TransmittedTorque, RisesBehindALag) {
  constexpr double kLag_s = 0.3;
  constexpr double kInterval_s = 0.1;
  const auto made = transmitted_torque_N_m({.lag_s = kLag_s}, std::vector(20, 1.0), kInterval_s,
                                           TorqueHold::zero);
  for (std::size_t k = 0; k < made.size(); ++k) {
    // Mean of 1 - e^(-t/T) over the interval.
    const double begin = std::exp(-static_cast<double>(k) * kInterval_s / kLag_s);
    const double mean = 1.0 - kLag_s / kInterval_s * begin * -std::expm1(-kInterval_s / kLag_s);
    EXPECT_NEAR(made[k], mean, 1e-12) << k;
  }
}

}  // namespace
}  // namespace flexarm::response
