// Residual mode, state space and product form of arms with linear effects.

#include "effects/registry/vocabulary.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/frequency/response_study.hpp"
#include "response/frequency/transfer_forms.hpp"
#include "response/residual_mode.hpp"
#include "tests/response/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;

struct Variation {
  std::string effect;
  std::vector<std::pair<std::string, double>> parameters;
};

/// The paper's arm, its payload and damping, with an effect each.
std::vector<std::pair<std::string, arm::Arm>> varied_arms() {
  const std::vector<Variation> variations = {
      {"hub_spring", {{"stiffness", 0.5}}},
      {"gravity", {{"acceleration", 9.81}}},
      {"gravity", {{"acceleration", -0.5}}},
      {"drive_compliance", {{"stiffness", 30.0}, {"rotor_share", 0.6}}},
      {"root_compliance", {{"stiffness", 30.0}}},
      {"local_stiffness_loss", {{"position", 0.4}, {"stiffness", 40.0}}},
      {"attached_mass", {{"mass", 0.04}, {"position", 0.5}}},
      {"tuned_mass",
       {{"mass", 0.01}, {"frequency", 20.0}, {"damping_ratio", 0.05}, {"position", 0.6}}},
      {"hub_radius", {{"radius", 0.05}}},
      {"payload_offset", {{"offset", 0.04}}},
      {"shear_and_rotary_inertia", {{"shear_coefficient", 5.0 / 6.0}}},
      {"air_damping", {{"coefficient", 0.05}}},
      {"structural_damping", {{"time", 1e-4}}},
  };
  std::vector<std::pair<std::string, arm::Arm>> arms;
  for (const auto& [effect, parameters] : variations) {
    arm::Arm arm = damped_arm();
    arm.beam.shear_modulus_Pa = 2.67e10;
    for (const auto& [parameter, value] : parameters) {
      effects::put(arm, effect, {{parameter, value}});
    }
    arms.emplace_back(effect, arm);
  }
  return arms;
}

double relative_error(const AnyFormulation& formulation, const arm::ModalModel& model,
                      std::size_t k, Complex s) {
  const Complex exact = transfer_function(formulation, every_sensor()[k], s);
  return std::abs(modal_response(model, every_sensor(), s)[k] - exact) / std::abs(exact);
}

/// Largest error of the response with and without residual mode between 4 modes kept, one a sensor.
struct Errors {
  std::vector<double> with;
  std::vector<double> without;
};

Errors errors_between_modes(const AnyFormulation& formulation) {
  const auto kept = modal_model(formulation, 4, every_sensor(), {});
  const auto corrected = with_residual_mode(formulation, kept, every_sensor());
  EXPECT_NO_THROW(require_consistent(corrected, every_sensor()));
  const double left_out = poles(formulation, 5).omega_rad_per_s.back();
  Errors errors;
  for (std::size_t k = 0; k < every_sensor().size(); ++k) {
    errors.with.push_back(0.0);
    errors.without.push_back(0.0);
    for (const double ratio : {0.03, 0.07, 0.15}) {
      const Complex s(0.0, ratio * left_out);
      errors.with[k] = std::max(errors.with[k], relative_error(formulation, corrected, k, s));
      errors.without[k] = std::max(errors.without[k], relative_error(formulation, kept, k, s));
    }
  }
  return errors;
}

TEST(EffectsResponse, AStaticCorrectionGainsADecadeAtEverySensorBetweenTheModes) {
  for (const auto& [effect, arm] : varied_arms()) {
    for (const char* name : kFormulations) {
      const auto errors = errors_between_modes(make_formulation(name, without_damping(arm), 20));
      for (std::size_t k = 0; k < every_sensor().size(); ++k) {
        EXPECT_LT(errors.with[k], 0.1 * errors.without[k])
            << name << " " << effect << " " << arm::to_string(every_sensor()[k]);
      }
    }
  }
}

// A root or a crack that loses nothing, in a beam that does, lets the modes kept shake those left
// out by their damping: that is no response to the torque, and stays.
TEST(EffectsResponse, AStaticCorrectionNeverHarmsADampedArm) {
  for (const auto& [effect, arm] : varied_arms()) {
    const auto errors = errors_between_modes(make_formulation("exact_tf", arm, 20));
    for (std::size_t k = 0; k < every_sensor().size(); ++k) {
      EXPECT_LT(errors.with[k], 0.7 * errors.without[k])
          << effect << " " << arm::to_string(every_sensor()[k]);
    }
  }
}

TEST(EffectsResponse, ASpringAtTheHubGivesTheStaticAngle) {
  constexpr double kStatic = 1e-9;
  arm::Arm arm = damped_arm();
  effects::put(arm, "hub_spring", {{"stiffness", 0.5}});
  for (const char* name : kFormulations) {
    const auto formulation = make_formulation(name, arm, 12);
    const auto kept = modal_model(formulation, 3, every_sensor(), {});
    const auto corrected = with_residual_mode(formulation, kept, every_sensor());
    EXPECT_NEAR(modal_response(corrected, every_sensor(), 0.0)[0].real(), 2.0, kStatic) << name;
    EXPECT_GT(std::abs(modal_response(kept, every_sensor(), 0.0)[0] - 2.0), 1e3 * kStatic) << name;
    // The beam carries no static load.
    EXPECT_NEAR(std::abs(modal_response(corrected, every_sensor(), 0.0)[5]), 0.0, kStatic) << name;
  }
}

TEST(EffectsResponse, TheLowestPoleOfAnArmThatIsHeldIsAResonance) {
  arm::Arm arm = damped_arm();
  effects::put(arm, "hub_spring", {{"stiffness", 0.5}});
  effects::put(arm, "sensor_lag", {{"time_constant", 1e-3}});
  ResponseOptions options;
  options.sensors = {{arm::SensorKind::hub_angle}};
  options.modes = 2;
  const auto study = study_response(arm, make_formulation("exact_tf", arm, 3), options);
  ASSERT_EQ(study.resonances[0].size(), 3U);
  EXPECT_EQ(study.resonances[0][0].order, 0);
  const double lowest = study.damped_poles.lowest.first_rad_per_s.imag();
  EXPECT_GT(lowest, 6.2832 * study.response.frequency_Hz.front());
  EXPECT_TRUE(study.chain.sensor_chains.empty()) << "tip_acceleration is not asked for";
  // A circle: below, above and its far point lie at equal distance from the centre.
  const auto& circle = study.resonances[0][0];
  const Complex centre = (circle.below + circle.above) / 2.0;
  const double radius = std::abs(circle.above - circle.below) / 2.0;
  EXPECT_NEAR(std::abs(circle.at_pole - centre), radius, 0.05 * radius);
}

TEST(EffectsResponse, AResonanceReachesTwoHalfWidthsHoweverNearItsNeighboursAre) {
  arm::Arm arm = damped_arm();
  effects::put(arm, "structural_damping", {{"time", 5e-3}});
  ResponseOptions options;
  options.sensors = {{arm::SensorKind::hub_angle}};
  options.modes = 2;
  const auto study = study_response(arm, make_formulation("exact_tf", arm, 4), options);
  ASSERT_FALSE(study.resonances[0].empty());
  bool has_overlap = false;
  for (const Resonance& resonance : study.resonances[0]) {
    const double half_width_Hz = std::abs(resonance.pole_rad_per_s.real()) / 6.283185307;
    const double pole_Hz = resonance.pole_rad_per_s.imag() / 6.283185307;
    has_overlap = has_overlap || half_width_Hz > 0.4 * pole_Hz;
    constexpr double kPoint = 0.98;  // the points are at equal angles: the last one is within
    EXPECT_LE(resonance.frequency_Hz.front(),
              std::max(0.52 * pole_Hz, pole_Hz - 2.0 * kPoint * half_width_Hz));
    EXPECT_GE(resonance.frequency_Hz.back(), pole_Hz + 2.0 * kPoint * half_width_Hz);
    const auto within = std::ranges::count_if(resonance.frequency_Hz, [&](double f_Hz) {
      return std::abs(f_Hz - pole_Hz) <= half_width_Hz;
    });
    EXPECT_GT(within, 100) << "points of the half circle between the half-power points";
  }
  EXPECT_TRUE(has_overlap) << "no case of the kind";
}

TEST(EffectsResponse, WhatHoldsTheHubSetsThePowerOfS) {
  constexpr double kCircle = 1e-9;
  arm::Arm sprung = damped_arm();
  effects::put(sprung, "hub_spring", {{"stiffness", 0.5}});
  arm::Arm hanging = damped_arm();
  effects::put(hanging, "gravity", {{"acceleration", 9.81}});
  for (const char* name : kFormulations) {
    const auto spring = make_formulation(name, sprung, 8);
    const auto angle = product_factors(spring, every_sensor()[0], 4);
    EXPECT_EQ(angle.power, 0) << name;
    EXPECT_FALSE(angle.turns_freely) << name;
    EXPECT_NEAR(angle.gain, 2.0, kCircle) << name;
    EXPECT_EQ(product_factors(spring, every_sensor()[2], 4).power, 2) << name;
    EXPECT_EQ(product_factors(spring, every_sensor()[5], 4).power, 2)
        << name << ": no static load bends the beam";
    EXPECT_EQ(product_factors(make_formulation(name, hanging, 8), every_sensor()[5], 4).power, 0)
        << name << ": its weight does";
  }
}

TEST(EffectsResponse, TheProductWithTheLowestPoleIsTheResponseAtLowFrequencies) {
  constexpr double kTail = 5e-3;  // of sum (1/z_pole - 1/z_zero) after 6 pairs
  for (const auto& [effect, arm] : varied_arms()) {
    const auto formulation = make_formulation("exact_tf", without_damping(arm), 8);
    for (const auto& sensor : every_sensor()) {
      const auto factors = product_factors(formulation, sensor, 6);
      const Complex s(0.0, 20.0);
      const Complex exact = transfer_function(formulation, sensor, s);
      EXPECT_LT(std::abs(value(factors, s) - exact), kTail * std::abs(exact))
          << effect << " " << arm::to_string(sensor);
    }
  }
}

}  // namespace
}  // namespace flexarm::response
