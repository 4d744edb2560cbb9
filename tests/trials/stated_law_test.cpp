// Laws of hub torque that an arm file states, against the simulator of the trials, which has the
// same laws by itself.
#include "effects/registry/vocabulary.hpp"
#include "fem/fem_arm.hpp"
#include "measured/files/arm_file.hpp"
#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/time_simulation.hpp"
#include "tests/trials/trial_arms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace flexarm::trials {
namespace {

struct StatedLaw {
  std::string name;
  std::vector<HiddenCause> hidden;
  std::string stated;  ///< the same in an arm file
};

void PrintTo(const StatedLaw& one, std::ostream* out) {
  *out << one.name;
}

class StatedLawAgainstTrials : public testing::TestWithParam<StatedLaw> {};

TEST_P(StatedLawAgainstTrials, EveryChannelAgrees) {
  // As simulator_test.cpp: speeds of a mode are off by (omega h)^2/12, turning points by some h.
  constexpr double kTolerance = 1e-4;
  constexpr std::size_t kSamplesCompared = 1000;
  const TrialArm& of = trial_arms().front();
  Random random(7, "stated law");
  std::vector<double> torque = random_torque(0.06, random);
  torque.resize(kSamplesCompared);
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle, 0.0},
                                            {arm::SensorKind::hub_velocity, 0.0},
                                            {arm::SensorKind::tip_acceleration, 0.0},
                                            {arm::SensorKind::strain, 0.05}};
  const auto own = simulate_in_time(World{of.arm, GetParam().hidden}, sensors, torque);
  const auto ideal = simulate_in_time(World{of.arm, {}}, sensors, torque);

  const arm::Arm arm =
      measured::parse_arm(measured::format_arm(of.arm) + "\n[effects.my_law]\n" + GetParam().stated,
                          "stated.toml", effects::vocabulary());
  const response::ArmParts parts = response::take_apart(arm);
  const response::AnyFormulation model = fem::FemArm(parts.linear);
  const auto other =
      response::simulate(response::time_model(model, parts, PlantOptions{}.flexible_modes, sensors),
                         parts, sensors, torque, {.sample_time_s = kSampleTime_s});
  const auto distance = [](const std::vector<double>& one, const std::vector<double>& two) {
    double difference = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k < one.size(); ++k) {
      difference += std::pow(one[k] - two[k], 2);
      square += std::pow(two[k], 2);
    }
    return std::sqrt(difference / square);
  };
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    EXPECT_LT(distance(own[i], other.channels[i]), kTolerance) << arm::to_string(sensors[i]);
    EXPECT_GT(distance(own[i], ideal[i]), 100.0 * kTolerance) << arm::to_string(sensors[i]);
  }
}

const HiddenCause kHardening{"hub_hardening_spring", {{"coefficient", 60.0}}};
const HiddenCause kCoulomb{"coulomb_friction", {{"torque", 0.012}}};

INSTANTIATE_TEST_SUITE_P(
    , StatedLawAgainstTrials,
    testing::Values(
        StatedLaw{"Cubic", {kHardening}, "hub_torque = \"-k*theta^3\"\nk = 60.0\n"},
        StatedLaw{"Coulomb", {kCoulomb}, "hub_torque = \"-F*sign(omega)\"\nF = 0.012\n"},
        StatedLaw{"CubicAndCoulomb",
                  {kHardening, kCoulomb},
                  "hub_torque = \"-k*theta^3 - F*sign(omega)\"\nk = 60.0\nF = 0.012\n"},
        StatedLaw{"Stribeck",
                  {{"stribeck_friction",
                    {{"torque", 0.008}, {"static_torque", 0.014}, {"velocity", 0.3}}}},
                  "hub_torque = \"-(F + (S - F)*exp(-(omega/v)^2))*sign(omega)\"\nF = 0.008\n"
                  "S = 0.014\nv = 0.3\n"},
        StatedLaw{"Ripple",
                  {{"torque_ripple", {{"amplitude", 0.02}, {"cycles", 7.0}, {"phase", 0.4}}}},
                  "hub_torque = \"a*sin(7*theta + 0.4)\"\na = 0.02\n"},
        StatedLaw{"SpringAndDashpot",
                  {{"hub_spring", {{"stiffness", 0.6}}},
                   {"hub_viscous_friction", {{"coefficient", 0.01}}}},
                  "hub_torque = \"-k*theta - 0.01*omega\"\nk = 0.6\n"}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace flexarm::trials
