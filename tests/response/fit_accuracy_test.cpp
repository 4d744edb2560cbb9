// Simulations of a fit take the longest steps that do: their error beside short ones.
#include "effects/registry/vocabulary.hpp"
#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

/// Of what a sensor shows: noise is 5e-3 in good recordings, and an effect is told by a part of it.
constexpr double kFarBelowNoise = 2e-3;

struct FittedForce {
  std::string effect;
  std::map<std::string, double> numbers;
};

void PrintTo(const FittedForce& force, std::ostream* out) {
  *out << force.effect;
}

class SimulationOfAFit : public testing::TestWithParam<FittedForce> {};

TEST_P(SimulationOfAFit, IsThatOfShortSteps) {
  constexpr int kModes = 5;
  constexpr double kSample_s = 2e-3;
  const std::vector<arm::Sensor> sensors = {kHubAngle, kHubVelocity, kTipAcceleration};
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.effects.insert(effects::named(GetParam().effect, GetParam().numbers));
  const ArmParts parts = take_apart(arm);
  const arm::ModalModel model =
      time_model(make_formulation("exact_tf", parts.linear, kModes), parts, kModes, sensors);
  const auto torque_N_m =
      sample(RandomNoise{.rms_N_m = 0.05, .from_Hz = 0.2, .to_Hz = 40.0, .seed = 8},
             SampleGrid{800, kSample_s})
          .torque_N_m;
  const SimulationOptions options = options_of_fit(kSample_s, TorqueHold::zero);
  const Eigen::MatrixXd of_fit = ArmSimulator(model, parts, sensors, options).readings(torque_N_m);
  SimulationOptions resolved{.sample_time_s = kSample_s, .substeps = 40, .energy = false};
  resolved.force_tolerance = 1e-11;
  const Eigen::MatrixXd expected =
      ArmSimulator(model, parts, sensors, resolved).readings(torque_N_m);
  for (Eigen::Index j = 0; j < expected.cols(); ++j) {
    EXPECT_LE((of_fit.col(j) - expected.col(j)).norm(), kFarBelowNoise * expected.col(j).norm())
        << to_string(sensors[static_cast<std::size_t>(j)]);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Forces, SimulationOfAFit,
    testing::Values(FittedForce{"coulomb_friction", {{"torque", 0.012}}},
                    FittedForce{"stribeck_friction",
                                {{"torque", 0.012}, {"static_torque", 0.016}, {"velocity", 0.2}}},
                    FittedForce{"stribeck_friction",
                                {{"torque", 0.012}, {"static_torque", 0.016}, {"velocity", 0.02}}},
                    FittedForce{"hub_hysteresis", {{"torque", 0.012}, {"stiffness", 1.0}}},
                    FittedForce{"hub_hysteresis", {{"torque", 0.012}, {"stiffness", 10.0}}},
                    FittedForce{"hub_hysteresis", {{"torque", 0.012}, {"stiffness", 100.0}}},
                    FittedForce{"torque_ripple",
                                {{"amplitude", 0.01}, {"cycles", 9.0}, {"phase", 0.4}}},
                    FittedForce{"hub_hardening_spring", {{"coefficient", 0.5}}},
                    FittedForce{"quadratic_drag", {{"coefficient", 0.02}}}),
    [](const auto& each) { return each.param.effect + std::to_string(each.index); });

}  // namespace
}  // namespace flexarm::response
