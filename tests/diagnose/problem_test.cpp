#include "diagnose/search/problem.hpp"

#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <utility>
#include <vector>

namespace flexarm::diagnose {
namespace {

TEST(Problem, LoweredNoiseIsThatOfTheResiduals) {
  const Experiment experiment = simulated_experiment({});
  constexpr double kTooLarge = 10.0;
  Observations observations = observe(experiment);
  for (ObservedChannel& channel : observations.channels) channel.noise *= kTooLarge;
  observations.deviations *= kTooLarge;
  Problem problem(experiment, std::move(observations));
  const Candidate truth = problem.as_filed();
  const auto mean_square = [&] {
    const auto residuals = problem.residuals(truth, problem.estimation_runs());
    const Misfit left =
        misfit(problem.observations(), experiment, residuals.value(), problem.estimation_runs());
    return left.sum_of_squares / left.count;
  };
  EXPECT_LT(mean_square(), 2.0 / (kTooLarge * kTooLarge));
  EXPECT_TRUE(problem.lower_noise(truth));
  // The level of the noise is known to a tenth of its power.
  EXPECT_NEAR(mean_square(), 1.0, kNoiseKnown);
}

TEST(Problem, WhatAnArmShowedLastIsThatOfThisArm) {
  const Experiment experiment = simulated_experiment({});
  const Problem problem(experiment);
  arm::Arm other = experiment.arm;
  other.hub.inertia_kg_m2 *= 1.5;
  const std::vector<bool> all(experiment.runs.size(), true);
  const auto shown = [&](const arm::Arm& arm) { return problem.predictor()(arm, all); };
  const Eigen::VectorXd first = shown(experiment.arm);
  EXPECT_EQ(shown(experiment.arm), first);
  EXPECT_NE(shown(other), first);
  EXPECT_EQ(shown(other), Problem(experiment).predictor()(other, all));
  EXPECT_EQ(shown(experiment.arm), first);
}

TEST(ModesNeeded, AreTheFewestAfterTheDeadline) {
  const Experiment experiment = simulated_experiment({});
  const Observations observations = observe(experiment);
  const ModeChoice made = modes_needed(experiment, observations, std::chrono::steady_clock::now());
  EXPECT_EQ(made.flexible_modes, kFewestModes);
  EXPECT_EQ(made.errors, std::vector<double>(observations.channels.size(), 0.0));
  const ModeChoice whole = modes_needed(experiment, observations);
  EXPECT_GE(whole.flexible_modes, kFewestModes);
  EXPECT_NE(whole.errors, made.errors);
}

}  // namespace
}  // namespace flexarm::diagnose
