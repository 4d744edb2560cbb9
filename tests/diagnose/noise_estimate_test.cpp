// Noise models of runs in which an unrecorded torque acts on the hub.
#include "arm/input_error.hpp"
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kDisturbance_N_m = 0.01;
constexpr double kCorrelation_s = 0.05;

/// Half of the usual time: the grey box costs some ten times a simulation.
constexpr SimulatedRuns kShortRuns{.duration_s = 2.0};

/// The recorded torque lacks a Gauss-Markov part of what acted.
Experiment with_unrecorded_torque(Experiment experiment, std::uint64_t seed) {
  response::RandomNumbers random(seed);
  for (auto& run : experiment.runs) {
    auto& record = std::get<measured::TimeRecord>(run.data);
    const double kept = std::exp(-measured::sampling_period_s(record) / kCorrelation_s);
    double torque_N_m = kDisturbance_N_m * random.normal();
    for (double& recorded : record.torque_N_m) {
      recorded -= torque_N_m;
      torque_N_m = kept * torque_N_m +
                   kDisturbance_N_m * std::sqrt(1.0 - kept * kept) * random.normal();
    }
  }
  return experiment;
}

std::vector<std::string> named_by(const Selection& selection) {
  std::vector<std::string> names;
  for (const Hypothesis& effect : selection.chosen.fit.candidate.effects) {
    names.push_back(effect.effect);
  }
  return names;
}

TEST(NoiseEstimate, FindsDeviationAndCorrelationTimeOfAnUnrecordedTorque) {
  const Experiment experiment = with_unrecorded_torque(simulated_experiment({}), 5);
  const Problem problem(experiment);
  const NoiseEstimator estimator(experiment, problem.observations(), problem.predictor());
  const NoiseEstimate found =
      estimator.model(trial_arm(), std::vector<bool>(experiment.runs.size(), true));
  // Of some 16 s, 320 correlation times: 3 standard errors are 15 and 30 %.
  EXPECT_NEAR(found.model.disturbance_N_m, kDisturbance_N_m, 0.15 * kDisturbance_N_m);
  EXPECT_NEAR(found.model.correlation_time_s, kCorrelation_s, 0.35 * kCorrelation_s);
  for (const auto& [sensor, factor] : found.model.reading_factors) {
    EXPECT_LE(factor, 1.2) << sensor;
  }
}

TEST(NoiseEstimate, EndsWhereItIsCancelled) {
  const Experiment experiment = simulated_experiment({}, kShortRuns);
  const Problem problem(experiment);
  const NoiseEstimator estimator(experiment, problem.observations(), problem.predictor(),
                                 [asked = 0]() mutable {
                                   if (++asked == 5) throw Cancelled{};
                                 });
  EXPECT_THROW(estimator.model(trial_arm(), std::vector<bool>(experiment.runs.size(), true)),
               Cancelled);
}

TEST(NoiseEstimate, OfARunWithoutDisturbanceIsNegligible) {
  const Experiment experiment = simulated_experiment({}, kShortRuns);
  const Problem problem(experiment);
  const NoiseEstimator estimator(experiment, problem.observations(), problem.predictor());
  const NoiseEstimate found =
      estimator.model(trial_arm(), std::vector<bool>(experiment.runs.size(), true));
  EXPECT_LE(found.model.disturbance_N_m, kNegligibleDisturbance * estimator.torque_rms_N_m());
}

TEST(PredictorChoice, OutputErrorWhereItLeavesNoise) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.01}})});
  const auto made = select_by_evidence(
      experiment, named(experiment, {"coulomb_friction", "hub_spring"}), {}, {});
  EXPECT_EQ(made.predictor, PredictorKind::output_error);
  EXPECT_THAT(named_by(made.selection), testing::ElementsAre("coulomb_friction"));
}

TEST(PredictorChoice, OutputErrorWhereASensorIsTooLateForAFilter) {
  Experiment experiment = with_unrecorded_torque(simulated_experiment({}, kShortRuns), 8);
  const std::string sensor = arm::to_string(
      std::get<measured::TimeRecord>(experiment.runs.front().data).channels.front().sensor);
  effects::put(experiment.arm, "sensor_delay", {{"delay", 0.5}}, sensor);
  const auto some = named(experiment, {"coulomb_friction"});
  const auto made = select_by_evidence(experiment, some, {}, {});
  EXPECT_EQ(made.predictor, PredictorKind::output_error);
  EXPECT_THAT(made.reason, testing::HasSubstr("no Kalman filter can be formed"));
  EXPECT_THAT(made.reason, testing::HasSubstr("at most"));
  EXPECT_THROW(select_by_evidence(experiment, some, {.predictor = PredictorKind::grey_box}, {}),
               arm::InputError);
}

TEST(GreyBox, HasTheDelayOfALateSensorAsItsBestFit) {
  const Experiment experiment = with_unrecorded_torque(
      simulated_experiment({effects::named("sensor_delay", {{"delay", 0.009}}, "hub_angle")},
                           kShortRuns),
      6);
  const Problem problem(experiment, {.noise = NoiseModel{kDisturbance_N_m, kCorrelation_s}});
  const auto all = named(experiment, {"sensor_delay"});
  const auto late = *std::ranges::find(all, "hub_angle", &Hypothesis::sensor);
  const Fit found = fit(problem, Candidate{}.with(late, {0.0075}));
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.candidate.values.front(), 0.009, 2e-4);
}

/// The filtering predictors, as they are asked for.
class FilteringPredictor : public testing::TestWithParam<PredictorKind> {
 protected:
  static PredictedSelection selected(const Experiment& experiment) {
    return select_by_evidence(
        experiment, named(experiment, {"coulomb_friction", "hub_spring", "payload_mass"}),
        {.predictor = GetParam()}, {});
  }
};
INSTANTIATE_TEST_SUITE_P(All, FilteringPredictor,
                         testing::Values(PredictorKind::grey_box, PredictorKind::torque_balance),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

TEST_P(FilteringPredictor, NamesFrictionUnderAnUnrecordedTorque) {
  const Experiment experiment = with_unrecorded_torque(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}})}, kShortRuns), 6);
  const auto made = selected(experiment);
  EXPECT_EQ(made.predictor, GetParam());
  ASSERT_THAT(named_by(made.selection), testing::ElementsAre("coulomb_friction"));
  EXPECT_NEAR(made.selection.chosen.fit.candidate.values.front(), 0.02, 0.002);
}

TEST_P(FilteringPredictor, NamesNothingWhereOnlyAnUnrecordedTorqueIsHidden) {
  const Experiment experiment = with_unrecorded_torque(simulated_experiment({}, kShortRuns), 8);
  EXPECT_THAT(named_by(selected(experiment).selection), testing::IsEmpty());
}

TEST(PredictorChoice, TorqueBalanceWhereOutputErrorDoesNotLeaveNoise) {
  const Experiment experiment = with_unrecorded_torque(simulated_experiment({}, kShortRuns), 9);
  const auto made = select_by_evidence(
      experiment, named(experiment, {"coulomb_friction", "hub_spring"}), {}, {});
  EXPECT_EQ(made.predictor, PredictorKind::torque_balance);
  EXPECT_THAT(named_by(made.selection), testing::IsEmpty());
}

TEST(PredictorChoice, BeamIsJudgedByTheMotionAndTheHubByItsTorqueBalance) {
  const Experiment experiment = with_unrecorded_torque(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}}),
                            effects::named("flexural_rigidity", {{"factor", 0.9}})},
                           kShortRuns),
      6);
  const auto made = select_by_evidence(
      experiment, named(experiment, {"coulomb_friction", "hub_spring", "flexural_rigidity"}), {},
      {});
  ASSERT_EQ(made.predictor, PredictorKind::torque_balance);
  ASSERT_TRUE(made.by_motion);
  ASSERT_THAT(named_by(*made.by_motion), testing::ElementsAre("flexural_rigidity"));
  ASSERT_THAT(named_by(made.selection), testing::ElementsAre("coulomb_friction"));
  const Candidate whole = made.whole(made.selection.chosen.fit.candidate);
  ASSERT_EQ(whole.values.size(), 2U);
  EXPECT_NEAR(whole.values[0], 0.9, 0.01);
  EXPECT_NEAR(whole.values[1], 0.02, 0.002);
  // The arm of the balance has the beam's effect already.
  const arm::Arm& balanced = made.selection.problem.experiment().arm;
  EXPECT_TRUE(balanced.effects.contains("flexural_rigidity"));
}

}  // namespace
}  // namespace flexarm::diagnose
