// Linear arms whose motions decay within a sample, or turn many times in it: steps are exact.
#include "response/time/step_check.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::response {
namespace {

constexpr double kPeriod_s = 5e-4;
constexpr std::size_t kSamples = 100;
constexpr double kPhase = 1e6;  // |A| dt
constexpr double kTorque_N_m = 0.3;

/// Squaring e^(A dt) log2 |A| dt times in extended precision, once a sample.
const double kSquaring =
    kPhase * static_cast<double>(std::numeric_limits<long double>::epsilon()) * kSamples;
/// Rounding of states and sums to double, once a sample.
constexpr double kStateRounding = 4 * std::numeric_limits<double>::epsilon() * kSamples;

ArmParts linear_parts(double hub_viscous_friction) {
  ArmParts parts = coulomb(0.0);
  parts.linear.hub.viscous_friction_N_m_s_per_rad = hub_viscous_friction;
  return parts;
}

TEST(StiffArm, OfAnInertiaInViscousFrictionIsTheClosedForm) {
  const double c = kPhase / kPeriod_s;
  const auto made = simulate(oscillator(1.0, 0.0, c), linear_parts(c), hub_sensors(),
                             step_torque(kTorque_N_m, kSamples), {.sample_time_s = kPeriod_s});
  EXPECT_EQ(made.summary.inner_steps, static_cast<std::int64_t>(kSamples) - 1);
  for (std::size_t k = 1; k < kSamples; ++k) {
    const double t = made.time_s[k];
    const double speed = -kTorque_N_m / c * std::expm1(-c * t);
    const double angle = kTorque_N_m / c * (t + std::expm1(-c * t) / c);
    EXPECT_NEAR(made.channels[0][k], angle, (kSquaring + kStateRounding) * angle) << k;
    EXPECT_NEAR(made.channels[1][k], speed, (kSquaring + kStateRounding) * speed) << k;
  }
  const EnergyBalance& energy = made.energy;
  EXPECT_NEAR(energy.work_in_J, kTorque_N_m * made.channels[0].back(),
              (kSquaring + kStateRounding) * energy.work_in_J);
  EXPECT_NEAR(energy.viscous_J, energy.work_in_J, 1e-3 * energy.work_in_J);
  EXPECT_LT(energy.largest_residual_J, (kSquaring + kStateRounding) * energy.work_in_J);
  EXPECT_LT(energy.material_air_J, kStateRounding * energy.viscous_J);
}

TEST(StiffArm, OfAnOverdampedSpringIsTheClosedForm) {
  constexpr double kStiffness = 1000.0;
  const double c = kPhase / kPeriod_s;
  const auto made = simulate(oscillator(1.0, kStiffness, c), linear_parts(0.0), hub_sensors(),
                             step_torque(kTorque_N_m, kSamples), {.sample_time_s = kPeriod_s});
  const double fast = -0.5 * (c + std::sqrt(c * c - 4.0 * kStiffness));
  const double slow = kStiffness / fast;
  for (std::size_t k = 1; k < kSamples; ++k) {
    const double t = made.time_s[k];
    const double angle = kTorque_N_m / kStiffness *
                         (slow * std::expm1(fast * t) - fast * std::expm1(slow * t)) /
                         (fast - slow);
    EXPECT_NEAR(made.channels[0][k], angle, (kSquaring + kStateRounding) * angle) << k;
  }
  EXPECT_LT(made.energy.largest_residual_J, (kSquaring + kStateRounding) * made.energy.work_in_J);
  EXPECT_GT(made.energy.material_air_J, 0.9 * made.energy.work_in_J);
}

TEST(StiffArm, ThatTurnsManyTimesInASampleIsTheClosedForm) {
  // cos(t) of t up to 5000 rounds by t epsilon.
  constexpr double kCosine = 5000.0 * 4 * std::numeric_limits<double>::epsilon();
  const auto made = simulate(oscillator(1.0, 1.0), linear_parts(0.0), hub_sensors(),
                             step_torque(1.0, kSamples), {.sample_time_s = 50.0});
  for (std::size_t k = 0; k < kSamples; ++k) {
    EXPECT_NEAR(made.channels[0][k], 1.0 - std::cos(made.time_s[k]), kCosine) << k;
  }
  EXPECT_LT(made.energy.largest_residual_J, kCosine);
}

/// Hub friction a million times that of the spring's own scale, lag and delay, torque that ramps
/// and clips.
TEST(StiffArm, OfTwoMassesBalancesItsEnergyAndDoesNotDependOnTheStep) {
  constexpr double kFriction = 1e6;
  arm::ModalModel model = two_masses(0.01, 0.05, 3.0);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      model.damping_rad_per_s[2 * i + j] =
          kFriction * model.modes[i].hub_slope * model.modes[j].hub_slope / model.modal_mass_kg_m2;
    }
  }
  ArmParts parts = linear_parts(kFriction);
  put(parts, "time_delay", {{"delay", 3e-3}});
  put(parts, "torque_saturation", {{"limit", 0.25}});
  put(parts, "actuator_lag", {{"time_constant", 1e-4}});
  put(parts, "torque_bias", {{"torque", 0.01}});
  std::vector<double> torque;
  for (int k = 0; k < 200; ++k) torque.push_back(0.3 * std::sin(0.05 * k));
  const SimulationOptions options{.sample_time_s = 2e-3, .hold = TorqueHold::first};
  const auto made = simulate(model, parts, hub_sensors(), torque, options);
  // Modal velocities are a million times the hub's, which is what is left of them.
  constexpr double kCancelled = kFriction * std::numeric_limits<double>::epsilon() * 200;
  EXPECT_GT(made.energy.work_in_J, 0.0);
  EXPECT_LT(made.energy.largest_residual_J, kCancelled * made.energy.work_in_J);
  EXPECT_GE(made.energy.lowest_loss_J, 0.0);
  const auto check = check_step(made, model, parts, hub_sensors(), torque, options);
  EXPECT_LT(*std::ranges::max_element(check.relative_difference), kCancelled);
}

}  // namespace
}  // namespace flexarm::response
