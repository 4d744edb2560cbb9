// The simulation for fits beside the exact one.
#include "response/time/arm_simulator.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

constexpr int kFlexibleModes = 5;
constexpr double kStep_s = 2e-3;
constexpr std::size_t kTwoSeconds = 1000;

std::vector<arm::Sensor> four_sensors() {
  return {arm::parse_sensor("hub_angle"), arm::parse_sensor("hub_velocity"),
          arm::parse_sensor("tip_acceleration"), arm::parse_sensor("strain@0.05")};
}

struct FitCase {
  std::string name;
  arm::Effects effects;
  double most = 0.0;   ///< error at one inner step, over the deviation of a signal
  double order = 0.0;  ///< in the inner step, at least; 0: exact, or (Stribeck) not of the inner
                       ///< step, but of the shortest one that a stop of the hub is halved to
};

void PrintTo(const FitCase& entry, std::ostream* out) {
  *out << entry.name;
}

class FitSimulation : public testing::TestWithParam<FitCase> {
 protected:
  FitSimulation() {
    arm_.damping.kelvin_voigt_s = 1.2e-4;
    arm_.hub.viscous_friction_N_m_s_per_rad = 2e-3;
    arm_.effects = GetParam().effects;
    const SampleGrid grid{kTwoSeconds, kStep_s};
    torque_ = sample(RandomNoise{.rms_N_m = 0.08, .from_Hz = 0.2, .to_Hz = 40.0, .seed = 4}, grid)
                  .torque_N_m;
  }

  /// Largest over the sensors of the root mean square error over the signal's deviation.
  double error(TorqueHold hold, int substeps) const {
    const auto sensors = four_sensors();
    const ArmParts parts = take_apart(arm_);
    const arm::ModalModel model = time_model(make_formulation("exact_tf", arm_, kFlexibleModes),
                                             parts, kFlexibleModes, sensors);
    const auto exact = simulate(model, parts, sensors, torque_,
                                {.sample_time_s = kStep_s, .hold = hold, .energy = false});
    SimulationOptions options = options_of_fit(kStep_s, hold);
    options.substeps = substeps;
    const Eigen::MatrixXd made = ArmSimulator(model, parts, sensors, options).readings(torque_);
    double largest = 0.0;
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      const auto expected = Eigen::VectorXd::Map(exact.channels[j].data(), made.rows());
      const auto column = made.col(static_cast<Eigen::Index>(j));
      largest = std::max(largest, (column - expected).norm() / expected.norm());
    }
    return largest;
  }

  arm::Arm arm_ = arm::paper_arm();
  std::vector<double> torque_;
};

TEST_P(FitSimulation, IsTheExactOneButForItsInnerSteps) {
  const auto& [name, effects, most, order] = GetParam();
  const double one = error(TorqueHold::zero, 1);
  RecordProperty("error", std::to_string(one));
  EXPECT_LE(one, most);
  if (order == 0.0) return;
  const double four = error(TorqueHold::zero, 4);
  EXPECT_GE(std::log(one / four) / std::log(4.0), order) << one << " and " << four;
}

TEST_P(FitSimulation, HoldsForATorqueThatIsLinearBetweenSamples) {
  EXPECT_LE(error(TorqueHold::first, 1), GetParam().most);
}

/// A sum of some thousand exact steps, in another order.
constexpr double kRoundingOfSteps = 1e-9;

/// Where forces vary: a step a sample of 2 ms, a hundredth of a period of the rigid-body motion.
constexpr double kOneStepASample = 1e-4;
/// A law that changes within a step is a parabola to 1 % of the largest torque, in the few steps of
/// a reversal: one step of ten, and as much at each kink where the load passes 0.
constexpr double kResolvedLaw = 2e-3;
/// 4, less what the steps that are cut at rests of the hub take.
constexpr double kOrder = 2.5;

INSTANTIATE_TEST_SUITE_P(
    Effects, FitSimulation,
    testing::Values(
        FitCase{"linear", {}, kRoundingOfSteps, 0.0},
        FitCase{"chain",
                {effects::named("time_delay", {{"delay", 3.3e-3}}),
                 effects::named("actuator_lag", {{"time_constant", 4e-3}}),
                 effects::named("torque_gain", {{"factor", 1.2}}),
                 effects::named("torque_bias", {{"torque", 0.004}}),
                 effects::named("sensor_lag", {{"time_constant", 2e-3}})},
                kRoundingOfSteps,
                0.0},
        FitCase{"readings",
                {effects::named("sensor_gain", {{"factor", 0.8}}),
                 effects::named("sensor_delay", {{"delay", 3.7e-3}}),
                 effects::named("sensor_offset", {{"value", 0.3}})},
                kRoundingOfSteps,
                0.0},
        FitCase{"clipped",
                {effects::named("torque_dead_zone", {{"width", 0.02}}),
                 effects::named("torque_saturation", {{"limit", 0.09}})},
                kRoundingOfSteps,
                0.0},
        FitCase{"coulomb",
                {effects::named("coulomb_friction", {{"torque", 0.012}})},
                kRoundingOfSteps,
                0.0},
        FitCase{"stribeck",
                {effects::named("stribeck_friction",
                                {{"torque", 0.008}, {"static_torque", 0.014}, {"velocity", 0.2}})},
                kOneStepASample,
                0.0},
        FitCase{"load_friction",
                {effects::named("load_friction", {{"factor", 0.2}, {"velocity", 0.2}})},
                kResolvedLaw,
                0.0},
        FitCase{"drag",
                {effects::named("quadratic_drag", {{"coefficient", 0.3}})},
                kOneStepASample,
                kOrder},
        FitCase{"ripple",
                {effects::named("torque_ripple",
                                {{"amplitude", 0.01}, {"cycles", 9.0}, {"phase", 0.4}})},
                kOneStepASample,
                kOrder}));

TEST(ArmSimulator, RefusesAReadingThatIsTooLarge) {
  const auto sensors = four_sensors();
  const ArmParts parts = take_apart(arm::paper_arm());
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", arm::paper_arm(), kFlexibleModes), parts,
                 kFlexibleModes, sensors);
  const std::vector<double> torque(4, 1e308);
  const ArmSimulator simulator(model, parts, sensors, options_of_fit(10.0, TorqueHold::zero));
  EXPECT_THROW(simulator.readings(torque), arm::InputError);
}

TEST(ArmSimulator, GoesOnFromAStateAsFreeReadingsSay) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1.2e-4;
  // Of the hub angle, the first of the sensors, the reading is late by a part of a sample.
  arm.effects = {effects::named("sensor_lag", {{"time_constant", 2e-3}}),
                 effects::named("sensor_delay", {{"delay", 7.3 * kStep_s}}, "hub_angle")};
  const auto sensors = four_sensors();
  const ArmParts parts = take_apart(arm);
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", arm, kFlexibleModes), parts, kFlexibleModes, sensors);
  const ArmSimulator simulator(model, parts, sensors, options_of_fit(kStep_s, TorqueHold::zero));
  const std::vector<double> torque =
      sample(RandomNoise{.rms_N_m = 0.08, .from_Hz = 0.2, .to_Hz = 40.0, .seed = 4},
             SampleGrid{200, kStep_s})
          .torque_N_m;
  const Eigen::VectorXd initial = Eigen::VectorXd::LinSpaced(simulator.states(), -0.3, 0.4);
  const Eigen::MatrixXd from_rest = simulator.readings(torque);
  const Eigen::VectorXd expected =
      from_rest.reshaped() + simulator.free_readings(torque.size()) * initial;
  const Eigen::MatrixXd from_state = simulator.readings(torque, initial);
  EXPECT_LE((from_state.reshaped() - expected).norm(), kRoundingOfSteps * expected.norm());
  EXPECT_GE((from_state - from_rest).norm(), 0.1 * from_rest.norm());
}

/// Readings of blocks of samples are those of the run, which goes step by step.
void expect_readings_of(const Simulation& by_steps, const Eigen::MatrixXd& made,
                        const std::vector<arm::Sensor>& sensors) {
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    const auto expected = Eigen::VectorXd::Map(by_steps.channels[j].data(), made.rows());
    EXPECT_LE((made.col(static_cast<Eigen::Index>(j)) - expected).norm(),
              kRoundingOfSteps * expected.norm())
        << arm::to_string(sensors[j]);
  }
}

TEST(ArmSimulator, ReadsTheSameForAnyNumberOfSamples) {
  // Readings of a linear arm are formed for blocks of samples (LiftedArm), the run step by step.
  arm::Arm arm = arm::paper_arm();
  arm.effects = {effects::named("time_delay", {{"delay", 2.3 * kStep_s}}),
                 effects::named("torque_bias", {{"torque", 0.004}}),
                 effects::named("sensor_offset", {{"value", 0.3}}, "strain@0.05"),
                 effects::named("sensor_delay", {{"delay", 7.3 * kStep_s}}, "hub_angle")};
  const auto sensors = four_sensors();
  const ArmParts parts = take_apart(arm);
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", arm, kFlexibleModes), parts, kFlexibleModes, sensors);
  const std::vector<double> all =
      sample(RandomNoise{.rms_N_m = 0.08, .from_Hz = 0.2, .to_Hz = 40.0, .seed = 4},
             SampleGrid{100, kStep_s})
          .torque_N_m;
  for (const TorqueHold hold : {TorqueHold::zero, TorqueHold::first}) {
    const ArmSimulator simulator(model, parts, sensors, options_of_fit(kStep_s, hold));
    for (const std::size_t samples : {1U, 2U, 8U, 15U, 16U, 17U, 32U, 33U, 100U}) {
      const auto torque = std::span(all).first(samples);
      SCOPED_TRACE(samples);
      const Eigen::MatrixXd made = simulator.readings(torque);
      ASSERT_EQ(made.rows(), std::ssize(torque));
      expect_readings_of(simulator.run(torque), made, sensors);
    }
  }
}

TEST(ArmSimulator, ReadsFrictionInBlocksAsStepByStep) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1.2e-4;
  arm.effects = {effects::named("coulomb_friction", {{"torque", 0.02}}),
                 effects::named("torque_bias", {{"torque", 0.004}}),
                 effects::named("torque_saturation", {{"limit", 0.3}}),
                 effects::named("sensor_offset", {{"value", 0.3}}, "strain@0.05"),
                 effects::named("sensor_delay", {{"delay", 3.0 * kStep_s}}, "hub_angle")};
  const auto sensors = four_sensors();
  const ArmParts parts = take_apart(arm);
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", arm, kFlexibleModes), parts, kFlexibleModes, sensors);
  const ArmSimulator simulator(model, parts, sensors, options_of_fit(kStep_s, TorqueHold::zero));
  // A hub that mostly sticks, that reverses now and then, and that mostly turns.
  for (const double rms_N_m : {0.012, 0.05, 0.4}) {
    const std::vector<double> torque =
        sample(RandomNoise{.rms_N_m = rms_N_m, .from_Hz = 0.2, .to_Hz = 10.0, .seed = 4},
               SampleGrid{kTwoSeconds, kStep_s})
            .torque_N_m;
    const Simulation by_steps = simulator.run(torque);
    EXPECT_GE(by_steps.summary.stops + by_steps.summary.reversals, 1) << rms_N_m;
    SCOPED_TRACE(rms_N_m);
    expect_readings_of(by_steps, simulator.readings(torque), sensors);
  }
}

TEST(ArmSimulator, ResolvesTheModesBelowTheNyquistFrequency) {
  constexpr double kRounding = 1e-13;  // sums of a few products
  const auto sensors = four_sensors();
  const arm::Arm arm = arm::paper_arm();
  const ArmParts parts = take_apart(arm);
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", arm, kFlexibleModes), parts, kFlexibleModes, sensors);
  for (const double sample_time_s : {1e-3, 1e-2, 1.0}) {
    const auto below = std::ranges::count_if(model.modes, [&](const auto& mode) {
      return mode.omega_rad_per_s * sample_time_s < std::numbers::pi;
    });
    const auto expected = std::max<Eigen::Index>(2, below);
    const ArmSimulator simulator(model, parts, sensors,
                                 options_of_fit(sample_time_s, TorqueHold::zero));
    EXPECT_EQ(simulator.resolved_states().cols(), 2 * expected) << sample_time_s;
    const Eigen::MatrixXd resting = simulator.resolved_states_of_resting_hub();
    ASSERT_EQ(resting.cols(), 2 * expected - 2) << sample_time_s;
    EXPECT_EQ(resting.colPivHouseholderQr().rank(), resting.cols()) << sample_time_s;
    // The hub's angle and velocity, the first two sensors, at the first sample.
    const Eigen::MatrixXd shown = simulator.free_readings(1);
    const Eigen::MatrixXd of_hub = shown.topRows(2) * resting;
    EXPECT_LE(of_hub.cwiseAbs().maxCoeff(), kRounding * shown.topRows(2).norm()) << sample_time_s;
  }
}

TEST(ArmSimulator, EndsAtTheDeadline) {
  arm::Arm arm = arm::paper_arm();
  arm.effects = {effects::named("stribeck_friction",
                                {{"torque", 0.012}, {"static_torque", 0.018}, {"velocity", 0.08}})};
  const auto sensors = four_sensors();
  const ArmParts parts = take_apart(arm);
  const ArmSimulator simulation(
      time_model(make_formulation("exact_tf", arm, kFlexibleModes), parts, kFlexibleModes, sensors),
      parts, sensors, options_of_fit(kStep_s, TorqueHold::zero));
  const std::vector<double> torque_N_m(kTwoSeconds, 0.05);
  EXPECT_EQ(simulation.readings(torque_N_m).rows(), static_cast<Eigen::Index>(kTwoSeconds));
  EXPECT_THROW(simulation.readings(torque_N_m, {}, std::chrono::steady_clock::now()),
               arm::Cancelled);
}

}  // namespace
}  // namespace flexarm::response
