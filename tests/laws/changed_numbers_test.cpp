// An arm whose numbers an effect changes (port arm_number) is the arm whose file has these numbers.
#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "laws/subjects.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace flexarm::laws {
namespace {

using arm::Arm;
using arm::Sensor;
using arm::SensorKind;

constexpr double kLonger = 1.1;
constexpr double kShorter = 0.5;
constexpr int kFewRoots = 3;

/// Every number of the beam, the hub and the payload.
void change(Arm& arm, double length_factor) {
  arm.beam.length_m *= length_factor;
  *arm.beam.thickness_m *= 1.2;
  arm.beam.given_flexural_rigidity_N_m2 = 1.5 * arm.beam.flexural_rigidity_N_m2();
  arm.beam.given_linear_density_kg_per_m = 1.3 * arm.beam.linear_density_kg_per_m();
  arm.beam.youngs_modulus_Pa.reset();  // a file gives no two rigidities
  arm.beam.density_kg_per_m3.reset();
  arm.hub.inertia_kg_m2 *= 1.4;
  arm.payload.mass_kg *= 0.7;
  arm.payload.inertia_kg_m2 *= 1.7;
  arm.damping.kelvin_voigt_s *= 0.6;
}

/// The arm with an effect that does so.
Arm by_effect(Arm arm, double length_factor) {
  arm.effects["changed_numbers"].definition =
      std::make_shared<const arm::EffectDefinition>(arm::EffectDefinition{
          .name = "changed_numbers",
          .meaning = "of this test",
          .parameters = {},
          .arm_number = [length_factor](const arm::Effect& /*effect*/, Arm& changed) {
            change(changed, length_factor);
          }});
  return arm;
}

Arm by_number(Arm arm, double length_factor) {
  change(arm, length_factor);
  return arm;
}

/// Of a file's arm; strain at its tip last.
std::vector<Sensor> sensors_of(const Arm& arm) {
  return {kHubAngle,
          kHubVelocity,
          kTipAcceleration,
          {SensorKind::tip_displacement},
          {SensorKind::tip_deflection},
          {SensorKind::strain, 0.05},
          {SensorKind::strain, arm.beam.length_m}};
}

class ChangedNumbers : public testing::TestWithParam<Subject> {
 protected:
  response::AnyFormulation model(const Arm& arm) const { return GetParam().make(arm); }
};

TEST_P(ChangedNumbers, AreThoseOfTheFileInAllThatAFormulationAnswers) {
  for (const double factor : {kLonger, kShorter}) {
    const Arm with_effect = by_effect(damped_arm(), factor);
    const Arm with_number = by_number(damped_arm(), factor);
    const auto a = model(with_effect);
    const auto b = model(with_number);
    EXPECT_EQ(response::poles(a, kFewRoots).omega_rad_per_s,
              response::poles(b, kFewRoots).omega_rad_per_s);
    const auto sensors = sensors_of(with_effect);
    const auto same = sensors_of(with_number);
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      EXPECT_EQ(response::zeros(a, sensors[k], 1).s_rad_per_s,
                response::zeros(b, same[k], 1).s_rad_per_s)
          << arm::to_string(sensors[k]);
      const std::complex<double> s(-1.0, 40.0);
      EXPECT_EQ(response::transfer_function(a, sensors[k], s),
                response::transfer_function(b, same[k], s))
          << arm::to_string(sensors[k]);
    }
    const std::array stations_m = {0.2, with_number.beam.length_m};
    const auto modes = response::modal_model(a, kFewRoots, sensors, stations_m);
    const auto expected = response::modal_model(b, kFewRoots, same, stations_m);
    EXPECT_EQ(modes.modal_mass_kg_m2, expected.modal_mass_kg_m2);
    EXPECT_EQ(modes.damping_rad_per_s, expected.damping_rad_per_s);
    ASSERT_EQ(modes.modes.size(), expected.modes.size());
    for (std::size_t i = 0; i < modes.modes.size(); ++i) {
      EXPECT_EQ(modes.modes[i].sensor_values, expected.modes[i].sensor_values);
      EXPECT_EQ(modes.modes[i].displacement_m, expected.modes[i].displacement_m);
    }
  }
}

TEST_P(ChangedNumbers, AreThoseOfTheFileInTime) {
  std::vector<double> torque;
  for (int k = 0; k < 100; ++k) torque.push_back(k % 40 < 20 ? 0.15 : -0.12);
  const auto simulated = [&](const Arm& arm, std::vector<Sensor> sensors) {
    auto parts = response::take_apart(arm);
    // Forces along the beam are summed at places of its own.
    const auto drag = [](std::span<const double> v_m_per_s, std::span<double> force_N_per_m) {
      for (std::size_t i = 0; i < v_m_per_s.size(); ++i) {
        force_N_per_m[i] -= 0.1 * std::abs(v_m_per_s[i]) * v_m_per_s[i];
      }
    };
    parts.beam_forces.push_back({"drag", {drag}});
    const auto time_model = response::time_model(model(parts.linear), parts, kFewRoots, sensors);
    return response::ArmSimulator(time_model, parts, sensors,
                                  response::options_of_fit(2e-3, response::TorqueHold::zero))
        .readings(torque);
  };
  const Arm with_effect = by_effect(damped_arm(), kLonger);
  const Arm with_number = by_number(damped_arm(), kLonger);
  EXPECT_EQ(simulated(with_effect, sensors_of(with_effect)),
            simulated(with_number, sensors_of(with_number)));
}

TEST_P(ChangedNumbers, ASensorBeyondTheChangedBeamIsRefusedAndAStationToo) {
  const auto shorter = model(by_effect(damped_arm(), kShorter));
  const Sensor beyond{SensorKind::strain, 0.5};
  EXPECT_THROW(response::zeros(shorter, beyond, 1), arm::InputError);
  EXPECT_THROW(response::modes(shorter, 1, std::array{beyond}, {}), arm::InputError);
  EXPECT_THROW(response::transfer_function(shorter, beyond, {0.0, 1.0}), arm::InputError);
  EXPECT_THROW(response::modes(shorter, 1, {}, std::array{0.5}), arm::InputError);
}

INSTANTIATE_TEST_SUITE_P(Formulations, ChangedNumbers, testing::ValuesIn(every_formulation()),
                         [](const auto& subject) { return subject.param.name; });

TEST(ChangedNumbersOfTheArm, PutATipSensorAtTheChangedTipAndNoOtherPlaceElsewhere) {
  const Arm arm = by_effect(arm::paper_arm(), kLonger);
  const double tip_m = arm::linear_arm(arm).length_m;
  EXPECT_EQ(arm::placed({SensorKind::strain, 0.96}, arm).position_m, tip_m);
  EXPECT_EQ(arm::placed({SensorKind::strain, 0.95}, arm).position_m, 0.95);
  EXPECT_EQ(arm::placed({SensorKind::strain, 1.0}, arm).position_m, 1.0);
  EXPECT_THROW(arm::placed({SensorKind::strain, 1.06}, arm), arm::InputError);
  const Arm no_payload_inertia = by_effect(arm::paper_arm(), kShorter);
  EXPECT_FALSE(arm::is_responsive({SensorKind::strain, 0.96}, no_payload_inertia));
  EXPECT_FALSE(arm::is_responsive({SensorKind::strain, 0.48}, no_payload_inertia));
  EXPECT_TRUE(arm::is_responsive({SensorKind::strain, 0.4}, no_payload_inertia));
}

TEST(ChangedNumbersOfTheArm, AreWhatAnEffectsPlaceMustFit) {
  Arm arm = by_effect(damped_arm(), kShorter);
  effects::put(arm, "local_stiffness_loss", {{"position", 0.4}, {"stiffness", 15.0}});
  EXPECT_NO_THROW(arm::require_valid(arm));
  effects::put(arm, "local_stiffness_loss", {{"position", 0.6}});
  EXPECT_THROW(arm::require_valid(arm), arm::InputError);
}

}  // namespace
}  // namespace flexarm::laws
