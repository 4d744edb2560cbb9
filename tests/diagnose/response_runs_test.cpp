// The predictor frequency_response: responses of `time` runs in their place.
#include "diagnose/predictors/response_runs.hpp"

#include "arm/input_error.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

const std::vector<std::string> kLinearEffects = {"flexural_rigidity", "torque_gain", "hub_inertia",
                                                 "payload_mass", "structural_damping"};

Experiment random_torques(const arm::Effects& hidden) {
  return simulated_experiment(hidden, {.duration_s = 16.0});
}

/// With a random walk in every reading, of this part of its signal at the end of a run.
Experiment with_random_walks(Experiment experiment, double part) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  for (auto& run : experiment.runs) {
    for (auto& channel : std::get<measured::TimeRecord>(run.data).channels) {
      double squares = 0.0;
      for (const double value : channel.values) squares += value * value;
      const auto n = static_cast<double>(channel.values.size());
      const double step = part * std::sqrt(squares / n) / std::sqrt(n);
      double walk = 0.0;
      for (double& value : channel.values) value += walk += step * normal(engine);
    }
  }
  return experiment;
}

std::vector<std::string> named_in(const PredictedSelection& made) {
  std::vector<std::string> names;
  for (const auto& effect : made.selection.chosen.fit.candidate.effects) {
    names.push_back(effect.effect);
  }
  return names;
}

TEST(ResponseRuns, AreResponsesOfTheArm) {
  const Experiment experiment = random_torques({});
  const auto responses = as_responses(experiment);
  ASSERT_TRUE(responses);
  ASSERT_EQ(responses->runs.size(), experiment.runs.size());
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    EXPECT_EQ(responses->runs[r].run.kind, measured::RunKind::frf);
    EXPECT_EQ(responses->runs[r].run.id, experiment.runs[r].run.id);
    EXPECT_EQ(responses->runs[r].run.purpose, experiment.runs[r].run.purpose);
    EXPECT_EQ(responses->runs[r].run.payload, experiment.runs[r].run.payload);
  }
  const Problem problem(*responses);
  const auto residuals = problem.residuals(problem.as_filed(), problem.estimation_runs());
  ASSERT_TRUE(residuals);
  const Misfit left =
      misfit(problem.observations(), *responses, *residuals, problem.estimation_runs());
  // Lines are biased where a segment does not resolve a resonance.
  constexpr double kLeakage = 2.0;
  EXPECT_LT(std::sqrt(left.sum_of_squares / left.count), kLeakage);
}

TEST(ResponseRuns, OfATorqueOfFewLinesThereAreNone) {
  Experiment experiment = random_torques({});
  for (auto& run : experiment.runs) {
    auto& record = std::get<measured::TimeRecord>(run.data);
    for (std::size_t k = 0; k < record.torque_N_m.size(); ++k) {
      record.torque_N_m[k] = std::sin(2.0 * std::numbers::pi * 3.0 * record.time_s[k]);
    }
  }
  EXPECT_FALSE(as_responses(experiment));
  EXPECT_THROW(
      select_by_evidence(experiment, named(experiment, kLinearEffects),
                         {.predictor = PredictorKind::frequency_response}, {}),
      arm::InputError);
}

// The search names a torque gain beside the rigidity.
TEST(FrequencyResponsePredictor, DISABLED_NamesALinearEffectUnderDrift) {
  const Experiment experiment = with_random_walks(
      random_torques({effects::named("flexural_rigidity", {{"factor", 0.9}})}), 1.0);
  const auto made = select_by_evidence(experiment, named(experiment, kLinearEffects),
                                       {.predictor = PredictorKind::frequency_response}, {});
  EXPECT_EQ(made.predictor, PredictorKind::frequency_response);
  ASSERT_THAT(named_in(made), testing::ElementsAre("flexural_rigidity"));
  EXPECT_NEAR(made.selection.chosen.fit.candidate.values.front(), 0.9, 0.002);
}

TEST(FrequencyResponsePredictor, NamesNothingOfDrift) {
  const Experiment experiment = with_random_walks(random_torques({}), 1.0);
  const auto made = select_by_evidence(experiment, named(experiment, kLinearEffects),
                                       {.predictor = PredictorKind::frequency_response}, {});
  EXPECT_THAT(named_in(made), testing::IsEmpty());
}

TEST(FrequencyResponsePredictor, IsNotTakenForFriction) {
  // The response of an arm with dry friction is noisy, so that it is soon as near as its noise.
  const Experiment experiment = with_random_walks(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}}),
                            effects::named("flexural_rigidity", {{"factor", 0.9}})},
                           {.duration_s = 6.0}),
      0.05);
  const auto made = select_by_evidence(
      experiment, named(experiment, {"flexural_rigidity", "coulomb_friction"}), {}, {});
  EXPECT_NE(made.predictor, PredictorKind::frequency_response);
  EXPECT_THAT(named_in(made), testing::Contains("coulomb_friction"));
}

}  // namespace
}  // namespace flexarm::diagnose
