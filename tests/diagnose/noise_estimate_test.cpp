// Noise models of runs in which an unrecorded torque acts on the hub.
#include "diagnose/predictors/noise_estimate.hpp"

#include "arm/input_error.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/time_model.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
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
      torque_N_m =
          kept * torque_N_m + kDisturbance_N_m * std::sqrt(1.0 - kept * kept) * random.normal();
    }
  }
  return experiment;
}

constexpr double kModalForce_N_m = 0.02;

/// White forces act on the flexible modes of the beam, too: responses to impulses at the samples
/// add up.
Experiment with_forces_on_modes(Experiment experiment, std::uint64_t seed) {
  const int flexible_modes = Problem(experiment).predictor().flexible_modes();
  response::RandomNumbers random(seed);
  for (auto& run : experiment.runs) {
    auto& record = std::get<measured::TimeRecord>(run.data);
    const double period_s = measured::sampling_period_s(record);
    std::vector<arm::Sensor> sensors;
    for (const measured::Channel& channel : record.channels) sensors.push_back(channel.sensor);
    const response::ArmParts parts = response::take_apart(arm_in(experiment, run.run));
    const arm::ModalModel model =
        response::time_model(response::make_formulation("exact_tf", parts.linear, flexible_modes),
                             parts, flexible_modes, sensors);
    const response::ArmSimulator simulator(
        model, parts, sensors, response::options_of_fit(period_s, response::TorqueHold::zero));
    const auto samples = static_cast<Eigen::Index>(record.time_s.size());
    const Eigen::MatrixXd free = simulator.free_readings(record.time_s.size());
    const Eigen::Index modes = flexible_modes + 1;
    const double impulse_rad_per_s = kModalForce_N_m * period_s / model.modal_mass_kg_m2;
    for (Eigen::Index k = 1; k < samples; ++k) {
      for (Eigen::Index mode = 1; mode < modes; ++mode) {
        const double size = impulse_rad_per_s * random.normal();
        for (std::size_t j = 0; j < record.channels.size(); ++j) {
          Eigen::VectorXd::Map(record.channels[j].values.data(), samples).tail(samples - k) +=
              size *
              free.col(modes + mode).segment(static_cast<Eigen::Index>(j) * samples, samples - k);
        }
      }
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

TEST(NoiseEstimate, FindsForcesOnTheModesBesideAnUnrecordedTorque) {
  const Experiment experiment =
      with_forces_on_modes(with_unrecorded_torque(simulated_experiment({}, kShortRuns), 5), 6);
  const Problem problem(experiment);
  const NoiseEstimator estimator(experiment, problem.observations(), problem.predictor());
  const std::vector<bool> all(experiment.runs.size(), true);
  const NoiseEstimate on_hub = estimator.model(trial_arm(), all);
  EXPECT_EQ(on_hub.model.modal_force_N_m, 0.0);
  const NoiseEstimate found = estimator.with_modal_force(trial_arm(), all, on_hub);
  EXPECT_LT(found.minus_two_log_likelihood, on_hub.minus_two_log_likelihood - 100.0);
  // What the modes above some hundred hertz show looks like noise of the acceleration, the least
  // of which is what the data show by themselves (observe): forces are found too small by that.
  EXPECT_NEAR(found.model.modal_force_N_m, kModalForce_N_m, 0.25 * kModalForce_N_m);
  // Of 160 correlation times.
  EXPECT_NEAR(found.model.disturbance_N_m, kDisturbance_N_m, 0.2 * kDisturbance_N_m);
}

TEST(NoiseEstimate, AsksForNoForcesOnTheModesWithoutAny) {
  const Experiment experiment = with_unrecorded_torque(simulated_experiment({}, kShortRuns), 5);
  const Problem problem(experiment);
  const NoiseEstimator estimator(experiment, problem.observations(), problem.predictor());
  const std::vector<bool> all(experiment.runs.size(), true);
  const NoiseEstimate on_hub = estimator.model(trial_arm(), all);
  const NoiseEstimate found = estimator.with_modal_force(trial_arm(), all, on_hub);
  EXPECT_EQ(found.model.modal_force_N_m, 0.0);
}

TEST(NoiseEstimate, HasTheFrictionThatTheArmLacksForADisturbance) {
  constexpr double kFriction_N_m = 0.02;
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", kFriction_N_m}})});
  const Problem problem(experiment);
  const NoiseEstimator estimator(experiment, problem.observations(), problem.predictor());
  const auto& runs = problem.estimation_runs();
  const NoiseModel noise = estimator.model(experiment.arm, runs).model;
  // The friction has that size wherever the hub turns. The filter's estimate is a projection: its
  // mean square is below that of the truth by the variance of its error.
  const double estimate_N_m =
      estimated_disturbance_N_m(problem.predictor(), experiment.arm, runs, noise);
  EXPECT_LT(estimate_N_m, kFriction_N_m);
  EXPECT_GT(estimate_N_m, 0.75 * kFriction_N_m);
}

TEST(PredictorChoice, OutputErrorWhereItLeavesNoise) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.01}})});
  const auto made =
      select_by_evidence(experiment, named(experiment, {"coulomb_friction", "hub_spring"}), {}, {});
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
  EXPECT_THAT(made.reason, testing::HasSubstr("no other can be formed"));
  EXPECT_THAT(made.reason, testing::HasSubstr("with a delay or a lag"));
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
    return select_by_evidence(experiment,
                              named(experiment, {"coulomb_friction", "hub_spring", "payload_mass"}),
                              {.predictor = GetParam()}, {});
  }
};
INSTANTIATE_TEST_SUITE_P(All, FilteringPredictor,
                         testing::Values(PredictorKind::grey_box, PredictorKind::torque_balance),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

TEST_P(FilteringPredictor, NamesFrictionUnderAnUnrecordedTorque) {
  const Experiment experiment = with_unrecorded_torque(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}})}, kShortRuns),
      6);
  const auto made = selected(experiment);
  EXPECT_EQ(made.predictor, GetParam());
  ASSERT_THAT(named_by(made.selection), testing::ElementsAre("coulomb_friction"));
  EXPECT_NEAR(made.selection.chosen.fit.candidate.values.front(), 0.02, 0.002);
}

TEST_P(FilteringPredictor, NamesNothingWhereOnlyAnUnrecordedTorqueIsHidden) {
  const Experiment experiment = with_unrecorded_torque(simulated_experiment({}, kShortRuns), 8);
  EXPECT_THAT(named_by(selected(experiment).selection), testing::IsEmpty());
}

TEST(PredictorChoice, TriesTheTorqueBalanceWhereOutputErrorDoesNotLeaveNoise) {
  const Experiment experiment = with_unrecorded_torque(simulated_experiment({}, kShortRuns), 9);
  const auto made =
      select_by_evidence(experiment, named(experiment, {"coulomb_friction", "hub_spring"}), {}, {});
  EXPECT_TRUE(made.balance);
  EXPECT_THAT(named_by(made.selection), testing::IsEmpty());
}

TEST(PredictorChoice, TorqueBalanceJudgesHubAndBeamByTheMotion) {
  const Experiment experiment = with_unrecorded_torque(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}}),
                            effects::named("flexural_rigidity", {{"factor", 0.9}})},
                           kShortRuns),
      6);
  const auto hypotheses =
      named(experiment, {"coulomb_friction", "hub_spring", "flexural_rigidity"});
  const Problem problem(experiment);
  const SelectionOptions options;
  const PredictedSelection made = select_by_balance({hypotheses, options}, problem, {});
  const Candidate& chosen = made.selection.chosen.fit.candidate;
  ASSERT_EQ(chosen.labels(), (std::set<std::string>{"coulomb_friction", "flexural_rigidity"}));
  for (std::size_t i = 0; i < chosen.effects.size(); ++i) {
    const bool is_friction = chosen.effects[i].effect == "coulomb_friction";
    EXPECT_NEAR(chosen.values_of(i).front(), is_friction ? 0.02 : 0.9, is_friction ? 0.002 : 0.01);
  }
}

}  // namespace
}  // namespace flexarm::diagnose
