// How far ahead a Kalman filter predicts the runs of an arm.
#include "diagnose/prediction_errors.hpp"

#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/time_model.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kUnrecorded_N_m = 0.01;
constexpr double kUnrecordedTime_s = 0.05;

NoiseModel known_noise() {
  return {.disturbance_N_m = kUnrecorded_N_m, .correlation_time_s = kUnrecordedTime_s};
}

/// The recorded torque lacks a Gauss-Markov part of what acted.
Experiment with_known_disturbance(Experiment experiment) {
  response::RandomNumbers random(9);
  for (auto& run : experiment.runs) {
    auto& record = std::get<measured::TimeRecord>(run.data);
    const double kept = std::exp(-measured::sampling_period_s(record) / kUnrecordedTime_s);
    double torque_N_m = kUnrecorded_N_m * random.normal();
    for (double& recorded : record.torque_N_m) {
      recorded -= torque_N_m;
      torque_N_m =
          kept * torque_N_m + kUnrecorded_N_m * std::sqrt(1.0 - kept * kept) * random.normal();
    }
  }
  return experiment;
}

/// Standard deviations of the innovations of the filter long after the first sample, a sensor each.
Eigen::VectorXd innovation_deviations(const Problem& problem, std::size_t r) {
  const auto& [run, data] = problem.experiment().runs[r];
  const auto& record = std::get<measured::TimeRecord>(data);
  std::vector<arm::Sensor> sensors;
  for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
  Eigen::VectorXd noise(std::ssize(sensors));
  for (const ObservedChannel& channel : problem.observations().channels) {
    if (channel.run != r) continue;
    const auto sensor = (channel.first - problem.observations().first_of_run[r]) / channel.count;
    noise(sensor) = problem.observations().deviations(channel.first);
  }
  arm::Arm arm = problem.experiment().arm;
  arm.payload = run.payload.value_or(arm.payload);
  response::ArmParts parts = response::take_apart(arm);
  parts.disturbance = {kUnrecordedTime_s};
  const int modes = problem.predictor().flexible_modes();
  const response::ArmSimulator simulator(
      response::time_model(response::make_formulation("exact_tf", parts.linear, modes), parts,
                           modes, sensors),
      parts, sensors,
      response::options_of_fit(measured::sampling_period_s(record),
                               simulated_hold(run.torque_hold)));
  return response::filter_gain(simulator.sampled({kUnrecorded_N_m}, noise))
      .innovation_covariance.diagonal()
      .cwiseSqrt();
}

TEST(PredictionErrors, OneSampleAheadAreThoseThatTheFilterStates) {
  const Experiment experiment = with_known_disturbance(simulated_experiment({}));
  const Problem problem(experiment, {.noise = known_noise()});
  const auto found = prediction_errors(problem, experiment.arm, experiment.arm);
  // Of 400 independent innovations the root mean square has a standard error of 3.5 %.
  constexpr double kFourErrors = 0.15;
  std::size_t compared = 0;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    if (!problem.judged_runs()[r]) continue;
    const Eigen::VectorXd stated = innovation_deviations(problem, r);
    Eigen::Index sensor = 0;
    for (const PredictionError& error : found) {
      if (error.run != experiment.runs[r].run.id || error.samples_ahead != 1U) continue;
      const auto& channels = std::get<measured::TimeRecord>(experiment.runs[r].data).channels;
      const auto& values = channels[static_cast<std::size_t>(sensor)].values;
      const Eigen::Map<const Eigen::ArrayXd> signal(values.data(), std::ssize(values));
      const double deviation = std::sqrt((signal - signal.mean()).square().mean());
      EXPECT_NEAR(error.before * deviation, stated(sensor), kFourErrors * stated(sensor))
          << error.sensor;
      EXPECT_DOUBLE_EQ(error.ahead_s, measured::sampling_period_s(
                                          std::get<measured::TimeRecord>(experiment.runs[r].data)));
      ++sensor;
      ++compared;
    }
  }
  EXPECT_GE(compared, 3U);
}

TEST(PredictionErrors, GrowWithTheSamplesAhead) {
  const Experiment experiment = with_known_disturbance(simulated_experiment({}));
  const auto found = prediction_errors(Problem(experiment, {.noise = known_noise()}),
                                       experiment.arm, experiment.arm);
  ASSERT_EQ(found.size() % 4, 0U);
  for (std::size_t i = 0; i < found.size(); i += 4) {
    ASSERT_EQ(found[i].samples_ahead, 1U);
    EXPECT_FALSE(found[i + 3].samples_ahead);
    // The sensor's own noise is in each of them.
    constexpr double kBySample = 0.95;
    EXPECT_GT(found[i + 1].before, kBySample * found[i].before) << found[i].sensor;
    EXPECT_GT(found[i + 2].before, kBySample * found[i + 1].before) << found[i].sensor;
    if (found[i].sensor == "hub_angle") {
      EXPECT_GT(found[i + 2].before, 2.0 * found[i].before);
      EXPECT_GT(found[i + 3].before, found[i + 2].before);
    }
  }
}

TEST(PredictionErrors, AreLessWithTheTrueCause) {
  // Without an unrecorded torque: the drift of the hub by that would be all of a simulation's
  // error.
  const arm::Effects hidden = {effects::named("hub_inertia", {{"factor", 1.4}})};
  const Experiment experiment = simulated_experiment(hidden);
  arm::Arm extended = experiment.arm;
  extended.effects = hidden;
  const auto found =
      prediction_errors(Problem(experiment, {.noise = known_noise()}), experiment.arm, extended);
  ASSERT_FALSE(found.empty());
  for (const PredictionError& error : found) {
    // One sample ahead both are near the noise.
    const bool is_next = error.samples_ahead == 1U;
    EXPECT_LT(error.after, (is_next ? 1.02 : 0.9) * error.before)
        << error.sensor << " " << error.samples_ahead.value_or(0);
  }
}

TEST(PredictionErrors, OfAnArmThatCannotBeComputedAreInfinite) {
  const Experiment experiment = simulated_experiment({}, {.duration_s = 1.0});
  arm::Arm none = experiment.arm;
  none.beam.length_m = -1.0;
  const auto found =
      prediction_errors(Problem(experiment, {.noise = known_noise()}), experiment.arm, none);
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(std::isfinite(found.front().before));
  EXPECT_TRUE(std::isinf(found.front().after));
}

}  // namespace
}  // namespace flexarm::diagnose
