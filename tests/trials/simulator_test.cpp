// The simulator of the trials against response/, with which it shares nothing but the arm.
#include "fem/fem_arm.hpp"
#include "response/arm_parts.hpp"
#include "response/settings.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/time_simulation.hpp"
#include "tests/trials/trial_arms.hpp"
#include "tests/trials/with_effects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace flexarm::trials {
namespace {

constexpr std::size_t kShortRun = 1000;

/// Root mean square of the difference over that of the reading. Speeds of a mode are off by
/// (omega h)^2/12, 2e-5 of the fourth; turning points of friction and drag by some h.
constexpr double kAgreement = 1e-4;

const std::map<std::string, std::vector<HiddenCause>> kTogether = {
    {"none", {}},
    {"linear",
     {{"gravity", {{"acceleration", 9.81}}}, {"root_compliance", {{"stiffness", 30.0}}}}},
    {"actuator",
     {{"torque_bias", {{"torque", 0.004}}},
      {"torque_saturation", {{"limit", 0.08}}},
      {"torque_dead_zone", {{"width", 0.01}}},
      {"time_delay", {{"delay", 0.0053}}},
      {"torque_gain", {{"factor", 0.8}}},
      {"actuator_lag", {{"time_constant", 0.004}}}}}};

/// Of a name in kTogether, or a cause alone at a typical size.
std::vector<HiddenCause> hidden_by_name(const std::string& name) {
  const auto together = kTogether.find(name);
  if (together != kTogether.end()) return together->second;
  constexpr double kTypicalPart = 0.1;  // of the largest size
  const TrialArm& of = trial_arms().front();
  const Cause& cause = find_cause(name);
  return with_hidden(World{of.arm}, of, cause, kTypicalPart * cause.largest, Chance{}).hidden;
}

std::vector<arm::Sensor> read_sensors() {
  return {{arm::SensorKind::hub_angle, 0.0},
          {arm::SensorKind::hub_velocity, 0.0},
          {arm::SensorKind::tip_acceleration, 0.0},
          {arm::SensorKind::strain, 0.05}};
}

class AgainstResponse : public testing::TestWithParam<std::string> {};

TEST_P(AgainstResponse, EveryChannelAgrees) {
  World world{trial_arms().front().arm};
  world.hidden = hidden_by_name(GetParam());
  Random random(7, "agreement");
  std::vector<double> torque = random_torque(0.06, random);
  torque.resize(kShortRun);
  const auto sensors = read_sensors();
  const auto own = simulate_in_time(world, sensors, torque);

  const response::ArmParts parts = response::take_apart(with_effects(world));
  const response::AnyFormulation model = fem::FemArm(parts.linear);
  const auto other =
      response::simulate(response::time_model(model, parts, PlantOptions{}.flexible_modes, sensors),
                         parts, sensors, torque, {.sample_time_s = kSampleTime_s});
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    double difference = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k < kShortRun; ++k) {
      difference += std::pow(own[i][k] - other.channels[i][k], 2);
      square += std::pow(other.channels[i][k], 2);
    }
    EXPECT_LT(std::sqrt(difference / square), kAgreement) << arm::to_string(sensors[i]);
  }
}

std::vector<std::string> together() {
  std::vector<std::string> names;
  for (const auto& [name, hidden] : kTogether) names.push_back(name);
  return names;
}

/// Every cause of the vocabulary that the linear arm does not hold.
std::vector<std::string> causes_alone() {
  std::vector<std::string> names;
  for (const Cause& cause : causes()) {
    if (!cause.outside && cause.acts_on > ActsOn::linear_arm) names.push_back(cause.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Alone, AgainstResponse, testing::ValuesIn(causes_alone()),
                         [](const auto& one) { return one.param; });
INSTANTIATE_TEST_SUITE_P(Together, AgainstResponse, testing::ValuesIn(together()),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace flexarm::trials
