// The simulation for fits beside the exact one.
#include "response/time/quick_simulation.hpp"

#include "arm/input_error.hpp"
#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
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

struct QuickCase {
  std::string name;
  arm::Effects effects;
  double most = 0.0;   ///< error at four inner steps, over the deviation of a signal
  double order = 0.0;  ///< in the inner step, at least; 0: exact
};

void PrintTo(const QuickCase& entry, std::ostream* out) {
  *out << entry.name;
}

class QuickSimulationOf : public testing::TestWithParam<QuickCase> {
 protected:
  QuickSimulationOf() {
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
    const Eigen::MatrixXd quick =
        QuickSimulation(model, parts, sensors,
                        {.sample_time_s = kStep_s, .hold = hold, .substeps = substeps})(torque_);
    double largest = 0.0;
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      const auto expected = Eigen::VectorXd::Map(exact.channels[j].data(), quick.rows());
      const auto column = quick.col(static_cast<Eigen::Index>(j));
      largest = std::max(largest, (column - expected).norm() / expected.norm());
    }
    return largest;
  }

  arm::Arm arm_ = arm::paper_arm();
  std::vector<double> torque_;
};

TEST_P(QuickSimulationOf, IsTheExactOneButForItsInnerSteps) {
  const auto& [name, effects, most, order] = GetParam();
  const double four = error(TorqueHold::zero, 4);
  RecordProperty("error", std::to_string(four));
  EXPECT_LE(four, most);
  if (order == 0.0) return;
  const double sixteen = error(TorqueHold::zero, 16);
  EXPECT_GE(std::log(four / sixteen) / std::log(4.0), order) << four << " and " << sixteen;
}

TEST_P(QuickSimulationOf, HoldsForATorqueThatIsLinearBetweenSamples) {
  // Where clipping breaks the torque within a sample, the sample has its mean.
  constexpr double kBroken = 0.02;
  EXPECT_LE(error(TorqueHold::first, 4), std::max(GetParam().most, kBroken));
}

/// A sum of some thousand exact steps, in another order.
constexpr double kRoundingOfSteps = 1e-9;

INSTANTIATE_TEST_SUITE_P(
    Effects, QuickSimulationOf,
    testing::Values(
        QuickCase{"linear", {}, kRoundingOfSteps, 0.0},
        QuickCase{"chain",
                  {{"time_delay", {{{"delay", 3.3e-3}}, ""}},
                   {"actuator_lag", {{{"time_constant", 4e-3}}, ""}},
                   {"torque_gain", {{{"factor", 1.2}}, ""}},
                   {"torque_bias", {{{"torque", 0.004}}, ""}},
                   {"sensor_lag", {{{"time_constant", 2e-3}}, ""}}},
                  kRoundingOfSteps,
                  0.0},
        QuickCase{"clipped",
                  {{"torque_dead_zone", {{{"width", 0.02}}, ""}},
                   {"torque_saturation", {{{"limit", 0.09}}, ""}}},
                  kRoundingOfSteps,
                  0.0},
        QuickCase{"coulomb", {{"coulomb_friction", {{{"torque", 0.012}}, ""}}}, 2e-3, 1.7},
        QuickCase{"stribeck",
                  {{"stribeck_friction",
                    {{{"torque", 0.008}, {"static_torque", 0.014}, {"velocity", 0.2}}, ""}}},
                  2e-3,
                  1.7},
        QuickCase{"drag", {{"quadratic_drag", {{{"coefficient", 0.3}}, ""}}}, 2e-3, 1.7},
        QuickCase{"ripple",
                  {{"torque_ripple", {{{"amplitude", 0.01}, {"cycles", 9.0}, {"phase", 0.4}}, ""}}},
                  2e-3,
                  1.7}));

TEST(QuickSimulationOfAnything, RefusesAReadingThatIsTooLarge) {
  const auto sensors = four_sensors();
  const ArmParts parts = take_apart(arm::paper_arm());
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", arm::paper_arm(), kFlexibleModes), parts,
                 kFlexibleModes, sensors);
  const std::vector<double> torque(4, 1e308);
  const QuickSimulation simulation(model, parts, sensors, {.sample_time_s = 10.0});
  EXPECT_THROW(simulation(torque), arm::InputError);
}

TEST(QuickSimulationOfAnything, GoesOnFromAStateAsFreeReadingsSay) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1.2e-4;
  arm.effects = {{"sensor_lag", {{{"time_constant", 2e-3}}, ""}}};
  const auto sensors = four_sensors();
  const ArmParts parts = take_apart(arm);
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", arm, kFlexibleModes), parts, kFlexibleModes, sensors);
  const QuickSimulation simulation(model, parts, sensors, {.sample_time_s = kStep_s});
  const std::vector<double> torque =
      sample(RandomNoise{.rms_N_m = 0.08, .from_Hz = 0.2, .to_Hz = 40.0, .seed = 4},
             SampleGrid{200, kStep_s})
          .torque_N_m;
  const Eigen::VectorXd initial = Eigen::VectorXd::LinSpaced(simulation.states(), -0.3, 0.4);
  const Eigen::MatrixXd from_rest = simulation(torque);
  const Eigen::VectorXd expected =
      from_rest.reshaped() + simulation.free_readings(torque.size()) * initial;
  const Eigen::MatrixXd from_state = simulation(torque, initial);
  EXPECT_LE((from_state.reshaped() - expected).norm(), kRoundingOfSteps * expected.norm());
  EXPECT_GE((from_state - from_rest).norm(), 0.1 * from_rest.norm());
}

}  // namespace
}  // namespace flexarm::response
