#include "response/time/single_modes.hpp"

#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

constexpr SampleGrid kRecord{1000, 0.0005};
constexpr int kAll = 120;
constexpr int kCoupled = 40;

const std::vector<arm::Sensor>& sensors() {
  static const std::vector<arm::Sensor> all = {{arm::SensorKind::hub_angle},
                                               {arm::SensorKind::hub_velocity},
                                               {arm::SensorKind::tip_acceleration},
                                               {arm::SensorKind::strain, 0.05}};
  return all;
}

arm::Arm plain() {
  arm::Arm made;
  made.beam.length_m = 0.96;
  made.beam.width_m = 0.019008;
  made.beam.thickness_m = 0.0032004;
  made.beam.density_kg_per_m3 = 2710.0;
  made.beam.youngs_modulus_Pa = 7.11e10;
  made.hub.inertia_kg_m2 = 5.86e-4;
  return made;
}

arm::ModalModel model_of(const arm::Arm& arm, int modes) {
  return time_model(make_formulation("exact_tf", arm, modes), take_apart(arm), modes, sensors());
}

/// Largest root mean square of a difference between the simulation of kAll modes and that of
/// kCoupled with the others added, over the rms of all.
double difference(const arm::Arm& arm, const Excitation& excitation, TorqueHold hold) {
  const auto torque_N_m = sample(excitation, kRecord).torque_N_m;
  const ArmParts parts = take_apart(arm);
  SimulationOptions options;
  options.sample_time_s = kRecord.period_s;
  options.hold = hold;
  options.energy = false;
  const auto whole = model_of(arm, kAll);
  const auto expected = simulate(whole, parts, sensors(), torque_N_m, options).channels;
  auto made = simulate(model_of(arm, kCoupled), parts, sensors(), torque_N_m, options);
  for (std::size_t mode = kCoupled + 1; mode <= kAll; ++mode) {
    add_readings_of_mode(made.channels, whole, mode, sensors(), made.hub_torque_N_m,
                         kRecord.period_s, hold);
  }
  double largest = 0.0;
  for (std::size_t j = 0; j < expected.size(); ++j) {
    double error = 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k < expected[j].size(); ++k) {
      error += std::pow(made.channels[j][k] - expected[j][k], 2);
      size += std::pow(expected[j][k], 2);
    }
    largest = std::max(largest, std::sqrt(error / size));
  }
  return largest;
}

// e^(A dt) in double: epsilon times the phase of the highest mode over a sample, 100 rad, and the
// samples.
constexpr double kRoundingOfStates = 1e-8;

TEST(SingleModes, UncoupledOnesAddUpToTheSimulationOfAll) {
  arm::Arm damped = plain();
  damped.damping.kelvin_voigt_s = 1e-6;
  damped.payload = {0.06, 1e-5};
  for (const arm::Arm& arm : {plain(), damped}) {
    for (const Excitation& excitation :
         {Excitation(BangBang{.pulse_s = 0.1}), Excitation(RandomNoise{}), Excitation(Prbs{})}) {
      for (const TorqueHold hold : {TorqueHold::zero, TorqueHold::first}) {
        EXPECT_LT(difference(arm, excitation, hold), kRoundingOfStates) << name(excitation);
      }
    }
  }
}

TEST(SingleModes, AViscousHubCouplesThemFarBelowTheToleranceOfTruncation) {
  constexpr double kTenthOfTolerance = 1e-5;
  for (const double friction : {1e-3, 1e-2}) {
    arm::Arm arm = plain();
    arm.hub.viscous_friction_N_m_s_per_rad = friction;
    EXPECT_TRUE(are_single(model_of(arm, kAll), kCoupled + 1));
    EXPECT_LT(difference(arm, BangBang{.pulse_s = 0.1}, TorqueHold::zero), kTenthOfTolerance);
  }
}

TEST(SingleModes, StrongDampingOfTheHubCouplesThem) {
  arm::Arm arm = plain();
  arm.hub.viscous_friction_N_m_s_per_rad = 30.0;
  EXPECT_FALSE(are_single(model_of(arm, kAll), kCoupled + 1));
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  EXPECT_TRUE(are_single(model_of(arm, kAll), 1));
}

}  // namespace
}  // namespace flexarm::response
