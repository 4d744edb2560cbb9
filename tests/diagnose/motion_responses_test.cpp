// Responses from the motion of the hub: the ratio of two responses to the torque.
#include "diagnose/diagnosis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kResponseNoise = 0.005;
constexpr int kRoots = 12;  // six times those below the highest frequency
const std::vector<arm::Sensor> kOutputs = {{arm::SensorKind::tip_acceleration, 0.0},
                                           {arm::SensorKind::tip_deflection, 0.0}};
constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle, 0.0};

/// Responses from the hub angle by finite elements, with noise.
measured::FrequencyRecord responses_to_hub(const arm::Arm& arm, double noise, std::uint64_t seed) {
  std::vector<double> frequency_Hz;
  for (int k = 0; k < 150; ++k) frequency_Hz.push_back(0.5 * std::pow(80.0, k / 149.0));
  std::vector<arm::Sensor> sensors = kOutputs;
  sensors.push_back(kHubAngle);
  const auto parts = response::take_apart(arm);
  const auto values =
      response::frequency_response(response::make_formulation("fem", arm, kRoots),
                                   response::linear_chain(parts), sensors, frequency_Hz)
          .values;
  response::RandomNumbers numbers(seed, 0);
  measured::FrequencyRecord record;
  record.input = kHubAngle;
  for (std::size_t j = 0; j < kOutputs.size(); ++j) {
    measured::FrequencyChannel channel{kOutputs[j], frequency_Hz, {}, {}};
    for (std::size_t k = 0; k < frequency_Hz.size(); ++k) {
      const std::complex<double> error(numbers.normal(), numbers.normal());
      channel.response.push_back(values[j][k] / values.back()[k] * (1.0 + noise * error));
      channel.coherence.push_back(NAN);
    }
    record.channels.push_back(channel);
  }
  return record;
}

Experiment measured_from_hub(const arm::Effects& hidden, double noise) {
  Experiment experiment;
  experiment.arm = trial_arm();
  arm::Arm arm = experiment.arm;
  arm.effects = hidden;
  for (const auto purpose : {measured::Purpose::estimation, measured::Purpose::validation}) {
    const bool is_estimation = purpose == measured::Purpose::estimation;
    measured::MeasuredRun made;
    made.run.id = is_estimation ? "first" : "second";
    made.run.kind = measured::RunKind::frf;
    made.run.purpose = purpose;
    made.data = responses_to_hub(arm, noise, is_estimation ? 1 : 2);
    experiment.runs.push_back(made);
  }
  return experiment;
}

TEST(MotionResponses, AreThoseOfFiniteElementsWhateverActsOnTheHub) {
  const Experiment experiment = measured_from_hub({}, 0.0);
  const Problem problem(experiment);
  arm::Arm other = experiment.arm;
  other.hub.inertia_kg_m2 *= 3.0;
  other.effects = {effects::named("hub_spring", {{"stiffness", 0.5}}),
                   effects::named("actuator_lag", {{"time_constant", 0.01}})};
  const Eigen::VectorXd& measured = problem.observations().values;
  for (const arm::Arm& arm : {experiment.arm, other}) {
    const Eigen::VectorXd predicted = problem.predictor()(arm, problem.estimation_runs());
    const Eigen::Index count = measured.size() / 2;  // of the run for estimation
    // Elements of order 4 on kRoots roots err by less than 1e-6 below the fourth.
    EXPECT_LT((predicted - measured).head(count).norm(), 1e-6 * measured.head(count).norm());
  }
}

TEST(MotionResponses, ShowAPayloadAndTheScaleOfASensor) {
  const Experiment experiment =
      measured_from_hub({effects::named("payload_mass", {{"mass", 0.03}}),
                         effects::named("sensor_gain", {{"factor", 0.73}}, "tip_acceleration"),
                         effects::named("hub_inertia", {{"factor", 2.0}})},
                        kResponseNoise);
  const Diagnosis made = diagnose(experiment, hypotheses(experiment));
  EXPECT_EQ(made.verdict, Verdict::explained);
  std::vector<std::string> named;
  for (const Cause& cause : made.causes) named.push_back(cause.effect);
  EXPECT_THAT(named, testing::UnorderedElementsAre("payload_mass", "sensor_gain"));
  for (const Cause& cause : made.causes) {
    const bool is_mass = cause.effect == "payload_mass";
    EXPECT_NEAR(cause.parameters.front().value, is_mass ? 0.03 : 0.73, is_mass ? 1e-3 : 3e-3);
  }
}

TEST(MotionResponses, OfAnotherHubAreAdequate) {
  const Experiment experiment =
      measured_from_hub({effects::named("hub_inertia", {{"factor", 2.0}}),
                         effects::named("hub_viscous_friction", {{"coefficient", 0.02}})},
                        kResponseNoise);
  const Diagnosis made = diagnose(experiment, hypotheses(experiment));
  EXPECT_EQ(made.verdict, Verdict::adequate);
  EXPECT_TRUE(made.causes.empty());
}

}  // namespace
}  // namespace flexarm::diagnose
