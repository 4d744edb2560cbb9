// An arm without a beam beside its closed forms, and what it refuses.
#include "response/rigid_hub.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/response_study.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

const arm::Sensor kAngle{arm::SensorKind::hub_angle};
const arm::Sensor kVelocity{arm::SensorKind::hub_velocity};
const arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration};
/// A few operations in double precision.
constexpr double kDigits = 1e-14;

arm::Arm hub_arm(double inertia, double friction = 0.0) {
  arm::Arm arm;
  arm.hub = {inertia, friction};
  return arm;
}

arm::Arm with(arm::Arm arm, const std::string& effect,
              const std::map<std::string, double>& parameters) {
  arm.effects[effect] = effects::effect(effect, parameters);
  return arm;
}

std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RigidHub, IsMadeWhateverTheFormulation) {
  for (const auto name_of_it : kFormulationNames) {
    const auto made = make_formulation(name_of_it, hub_arm(2.0), 3);
    EXPECT_EQ(name(made), "rigid_hub");
    EXPECT_EQ(degrees_of_freedom(made), 1);
    EXPECT_TRUE(poles(made, 3).omega_rad_per_s.empty());
    EXPECT_TRUE(zeros(made, kAngle, 3).s_rad_per_s.empty());
    EXPECT_EQ(name(with_arm(made, hub_arm(3.0))), "rigid_hub");
  }
}

TEST(RigidHub, HasItsRigidBodyMode) {
  const RigidHub free(hub_arm(2.0, 0.5));
  const std::vector<arm::Sensor> sensors = {kAngle, kVelocity};
  const auto model = free.modal_model(4, sensors, {});
  ASSERT_EQ(model.modes.size(), 1U);
  EXPECT_EQ(model.modal_mass_kg_m2, 2.0);
  EXPECT_EQ(model.modes[0].omega_rad_per_s, 0.0);
  EXPECT_EQ(model.modes[0].hub_slope, 1.0);
  EXPECT_EQ(model.modes[0].sensor_values, (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(model.damping_rad_per_s, (std::vector<double>{0.25}));
  const auto pair = free.damped_poles(1).lowest;
  EXPECT_EQ(pair.first_rad_per_s, Complex(0.0));
  EXPECT_EQ(pair.second_rad_per_s, Complex(-0.25));
}

TEST(RigidHub, TurnsOnItsSpring) {
  const RigidHub sprung(with(hub_arm(2.0, 0.5), "hub_spring", {{"stiffness", 18.0}}));
  EXPECT_EQ(sprung.poles(1).lowest_omega_squared_rad2_per_s2, 9.0);
  const auto pair = sprung.damped_poles(1).lowest;
  for (const Complex s : {pair.first_rad_per_s, pair.second_rad_per_s}) {
    EXPECT_LE(std::abs((2.0 * s + 0.5) * s + 18.0), kDigits * 18.0);
  }
  EXPECT_GT(pair.first_rad_per_s.imag(), 0.0);
  const auto mode = sprung.modal_model(1, {}, {}).modes[0];
  EXPECT_NEAR(mode.damping_ratio, 0.5 / (2.0 * std::sqrt(2.0 * 18.0)), kDigits);
  // The static gain.
  EXPECT_NEAR(sprung.transfer_function(kAngle, 0.0).real(), 1.0 / 18.0, kDigits);
  EXPECT_EQ(sprung.transfer_function(kVelocity, 0.0), Complex(0.0));
}

TEST(RigidHub, ASlowPoleKeepsItsDigitsBesideAFastOne) {
  const RigidHub overdamped(with(hub_arm(1.0, 1e8), "hub_spring", {{"stiffness", 1.0}}));
  const auto pair = overdamped.damped_poles(1).lowest;
  EXPECT_NEAR(pair.first_rad_per_s.real() * 1e8, -1.0, kDigits);
  EXPECT_NEAR(pair.second_rad_per_s.real() * 1e-8, -1.0, kDigits);
}

TEST(RigidHub, RespondsAsItsEquation) {
  const RigidHub made(hub_arm(2.0, 0.5));
  for (const Complex s : {Complex(0.0, 3.0), Complex(-0.4, 0.1), Complex(1e-3, 0.0)}) {
    const Complex expected = 1.0 / (2.0 * s * s + 0.5 * s);
    EXPECT_LE(std::abs(made.transfer_function(kAngle, s) - expected), kDigits * std::abs(expected));
    EXPECT_LE(std::abs(made.transfer_function(kVelocity, s) - s * expected),
              kDigits * std::abs(s * expected));
  }
  EXPECT_THROW(made.transfer_function(kAngle, 0.0), std::domain_error);
  EXPECT_THROW(made.transfer_function(kAngle, Complex(0.0, INFINITY)), std::domain_error);
}

/// Inertia and friction by a factor: the same motion under the torque by that factor.
TEST(RigidHub, ScalesWithInertiaAndFriction) {
  const Complex s(-0.2, 1.7);
  const Complex one = RigidHub(hub_arm(2.0, 0.5)).transfer_function(kAngle, s);
  const Complex other = RigidHub(hub_arm(20.0, 5.0)).transfer_function(kAngle, s);
  EXPECT_LE(std::abs(10.0 * other - one), kDigits * std::abs(one));
  const arm::Arm changed = with(hub_arm(2.0, 0.5), "hub_inertia", {{"factor", 1.5}});
  EXPECT_EQ(RigidHub(changed).transfer_function(kAngle, s),
            RigidHub(hub_arm(3.0, 0.5)).transfer_function(kAngle, s));
}

TEST(RigidHub, IsSimulatedAsItsClosedForm) {
  const double inertia = 95.1;
  const double friction = 203.5;
  const arm::Arm arm = hub_arm(inertia, friction);
  const ArmParts parts = take_apart(arm);
  const std::vector<arm::Sensor> sensors = {kAngle, kVelocity};
  const auto model = time_model(make_formulation("exact_tf", arm, 5), parts, 5, sensors, true);
  const std::vector<double> torque(2000, 40.0);
  const auto made =
      simulate(model, parts, sensors, torque, {.sample_time_s = 1e-3, .resolve_every_mode = true});
  const double last = 40.0 / friction;
  const double rate = friction / inertia;
  for (std::size_t k = 0; k < torque.size(); k += 100) {
    const double t = 1e-3 * static_cast<double>(k);
    ASSERT_NEAR(made.channels[1][k], -last * std::expm1(-rate * t), 1e-13) << k;
    ASSERT_NEAR(made.channels[0][k], last * (t + std::expm1(-rate * t) / rate), 1e-13) << k;
  }
  EXPECT_LE(std::abs(made.energy.residual_J()), 1e-12 * made.energy.work_in_J);
}

TEST(RigidHub, HasAFrequencyResponse) {
  const arm::Arm arm = hub_arm(2.0, 0.5);
  const auto formulation = make_formulation("exact_tf", arm, 1);
  ResponseOptions options;
  options.sensors = {kAngle, kVelocity};
  options.modes = 1;
  options.state_space = true;
  const auto study = study_response(arm, formulation, options);
  ASSERT_FALSE(study.response.frequency_Hz.empty());
  EXPECT_EQ(study.products[0].power, -2);
  EXPECT_NEAR(study.products[0].gain, 0.5, 1e-9);
  const double f = study.response.frequency_Hz.front();
  const Complex s(0.0, 2.0 * std::numbers::pi * f);
  EXPECT_LE(std::abs(study.response.values[0].front() - 1.0 / (2.0 * s * s + 0.5 * s)),
            1e-12 * std::abs(study.response.values[0].front()));
  EXPECT_LE(
      std::abs(study.state_space_response->values[0].front() - study.response.values[0].front()),
      1e-9 * std::abs(study.response.values[0].front()));
}

TEST(RigidHub, WhatNeedsABeamIsRefusedByName) {
  arm::Arm loaded = hub_arm(2.0);
  loaded.payload.mass_kg = 0.1;
  EXPECT_EQ(refusal_of([&] { arm::require_valid(loaded); }),
            "payload.mass = 0.1 kg: needs a beam; the arm file has no [beam]");
  arm::Arm damped = hub_arm(2.0);
  damped.damping.kelvin_voigt_s = 1e-4;
  EXPECT_EQ(refusal_of([&] { arm::require_valid(damped); }),
            "damping.kelvin_voigt = 0.0001 s: needs a beam; the arm file has no [beam]");
  EXPECT_EQ(refusal_of([&] { arm::require_valid(hub_arm(0.0)); }),
            "hub.inertia = 0 kg m^2: must be above 0 without a [beam]");
  EXPECT_EQ(refusal_of([&] { arm::require_valid(kTipAcceleration, hub_arm(2.0)); }),
            "sensor tip_acceleration: needs a beam; the arm file has no [beam]");
  EXPECT_EQ(refusal_of([&] { exact_tf::ExactArm refused(hub_arm(2.0)); }),
            "formulation: needs a beam; the arm file has no [beam]");
  EXPECT_EQ(refusal_of([&] { RigidHub refused(arm::paper_arm()); }),
            "rigid_hub: the arm has a [beam]");
  EXPECT_EQ(refusal_of([&] {
              arm::require_valid(with(hub_arm(2.0), "flexural_rigidity", {{"factor", 1.2}}));
            }),
            "effects.flexural_rigidity: needs a beam; the arm file has no [beam]");
}

/// An effect acts on a rigid hub exactly where none of its example changes anything but the hub,
/// the torque or a sensor.
TEST(RigidHub, TakesTheEffectsOfHubTorqueAndSensors) {
  const std::vector<std::string> known = {
      "actuator_lag",     "coulomb_friction",  "hub_inertia",          "hub_spring",
      "sensor_lag",       "stribeck_friction", "hub_viscous_friction", "time_delay",
      "torque_bias",      "torque_dead_zone",  "torque_gain",          "torque_ripple",
      "torque_saturation"};
  const std::vector<std::string> of_beam = {
      "air_damping",     "beam_length",        "beam_thickness",           "flexural_rigidity",
      "gravity",         "hub_radius",         "linear_density",           "local_stiffness_loss",
      "payload_inertia", "payload_mass",       "payload_offset",           "quadratic_drag",
      "root_compliance", "structural_damping", "shear_and_rotary_inertia", "attached_mass",
      "tuned_mass",      "root_damping",       "drive_compliance"};
  for (const auto& effect : effects::vocabulary()) {
    const bool acts = arm::acts_without_beam(*effect);
    const bool is_of_hub = std::ranges::count(known, effect->name) > 0;
    const bool is_of_beam = std::ranges::count(of_beam, effect->name) > 0;
    EXPECT_FALSE(acts ? is_of_beam : is_of_hub) << effect->name;
    arm::Effect example{.definition = effect};
    for (const auto& parameter : effect->parameters) {
      example.parameters[parameter.name] = parameter.example;
    }
    if (effect->sensor) example.sensor = "hub_angle";
    arm::Arm arm = hub_arm(2.0, 0.5);
    arm.effects[effect->name] = example;
    if (acts) {
      EXPECT_EQ(name(make_formulation("fem", arm, 2)), "rigid_hub") << effect->name;
    } else {
      EXPECT_THAT(refusal_of([&] { make_formulation("fem", arm, 2); }),
                  HasSubstr("effects." + effect->name + ": needs a beam"));
    }
  }
}

}  // namespace
}  // namespace flexarm::response
