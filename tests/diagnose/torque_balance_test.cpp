// Torque balance at the hub: what is missing of the torque for the motion that was measured.
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/closed_loop_axis.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

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
  const auto made = select_by_evidence(experiment, hypotheses_of_an_axis(experiment),
                                       {.predictor = PredictorKind::torque_balance}, {});
  EXPECT_EQ(made.predictor, PredictorKind::torque_balance);
  expect_friction_and_bias(made.selection);
}

}  // namespace
}  // namespace flexarm::diagnose
