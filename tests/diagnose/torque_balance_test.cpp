// Torque balance at the hub: what is missing of the torque for the motion that was measured.
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/search/admission.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/closed_loop_axis.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace flexarm::diagnose {
namespace {

TEST(TorqueBalance, EstimatesTheFrictionThatTheArmLacks) {
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

TEST(TorqueBalance, NamesFrictionAndBiasOfAClosedLoop) {
  const Experiment experiment = axis_experiment();
  const auto made = select_by_evidence(experiment, hypotheses_of_an_axis(experiment), {}, {});
  EXPECT_EQ(made.predictor, PredictorKind::torque_balance);
  expect_friction_and_bias(made.selection);
}

TEST(TorqueBalance, RunsAwayWhereMostOfTheTorqueIsLeftToADisturbance) {
  const Axis axis;
  const Experiment experiment = axis_experiment(axis);
  const Problem balanced(experiment, {.noise = NoiseModel{1.0, 0.1, 0.0, {}, 1.0}});
  const auto is_runaway = [&](const Candidate& candidate) {
    return runs_away(explain(balanced, fit(balanced, candidate)), {});
  };
  Candidate hub = balanced.as_filed();
  EXPECT_TRUE(is_runaway(hub));  // friction takes most of the torque
  for (const auto& [effect, value] :
       {std::pair{"coulomb_friction", axis.coulomb_N_m},
        std::pair{"hub_viscous_friction", axis.viscous_N_m_s_per_rad}}) {
    hub = hub.with(named(experiment, {effect}).front(), {value});
  }
  EXPECT_FALSE(is_runaway(hub));
}

TEST(OutputError, RunsAwayWithoutTheFrictionOfAClosedLoop) {
  const Experiment experiment = axis_experiment();
  const Problem simulated(experiment);
  EXPECT_TRUE(runs_away(explain(simulated, fit(simulated, simulated.as_filed())), {}));
}

}  // namespace
}  // namespace flexarm::diagnose
