// Torque balance at the hub: what is missing of the torque for the motion that was measured.
#include "diagnose/predictors/torque_balance.hpp"

#include "diagnose/motion_drive.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "diagnose/unknown/balanced_motion.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/closed_loop_axis.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace flexarm::diagnose {
namespace {

Problem balance_of(const Experiment& experiment) {
  return Problem(std::make_shared<const Experiment>(balanced_at_hub(experiment)), {});
}

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// Returns the missing torque, as means over a few samples: between two samples the acceleration of
/// a torque that is held is not that of a spline.
std::vector<double> missing_N_m(const Problem& problem, const arm::Effects& added = {}) {
  arm::Arm arm = problem.experiment().arm;
  arm.effects.insert(added.begin(), added.end());
  return balanced_motion(problem, arm, problem.estimation_runs()).missing_N_m;
}

TEST(TorqueBalance, IsTheTorqueThatTheArmLacks) {
  Axis axis;
  axis.unrecorded_N_m = 0.0;
  const Problem problem = balance_of(axis_experiment(axis));
  const arm::Effects lacking = {
      effects::named("coulomb_friction", {{"torque", axis.coulomb_N_m}}),
      effects::named("hub_viscous_friction", {{"coefficient", axis.viscous_N_m_s_per_rad}}),
      effects::named("torque_bias", {{"torque", axis.bias_N_m}})};
  EXPECT_GT(rms(missing_N_m(problem)), axis.coulomb_N_m);
  EXPECT_LT(rms(missing_N_m(problem, lacking)), 0.1 * axis.coulomb_N_m);
}

TEST(TorqueBalance, IsRelativeToTheTorqueThatReachesTheHub) {
  const auto friction = effects::named("coulomb_friction", {{"torque", 0.02}});
  const Problem problem = balance_of(simulated_experiment({friction}));
  const auto error = [&](const arm::Effects& added) {
    arm::Arm arm = problem.experiment().arm;
    arm.effects.insert(added.begin(), added.end());
    return problem.judged_error(arm);
  };
  const double as_filed = error({});
  // Neither a gain nor a dead zone that leaves nearly no torque makes a balance of it.
  EXPECT_GT(error({effects::named("torque_gain", {{"factor", 0.01}})}), 2.0 * as_filed);
  EXPECT_GT(error({effects::named("torque_dead_zone", {{"width", 10.0}})}), 2.0 * as_filed);
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
