// Unknown initial states and their prior.
#include "compare/initial_state.hpp"

#include "diagnose/predictors/filtered_run.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace flexarm::diagnose {
namespace {

using compare::InitialStateEstimator;
using compare::kLeastShown;
using compare::prior_of_state;
using Eigen::Index;

/// Two states that decay, of which readings show the sum.
Eigen::MatrixXd decaying() {
  Eigen::MatrixXd made(50, 2);
  for (Index k = 0; k < made.rows(); ++k) {
    made(k, 0) = std::exp(-0.1 * static_cast<double>(k));
    made(k, 1) = std::exp(-0.3 * static_cast<double>(k));
  }
  return made;
}

TEST(InitialState, IsEstimatedWhereReadingsShowIt) {
  const Eigen::MatrixXd per_state = decaying();
  const Eigen::Vector2d truth(0.7, -0.4);
  const Eigen::VectorXd readings = per_state * truth;
  const Eigen::VectorXd deviations = Eigen::VectorXd::Constant(50, 1e-6);
  const InitialStateEstimator estimator(per_state, deviations, readings);
  const Eigen::VectorXd found = estimator.step(readings, Eigen::VectorXd::Zero(2));
  // The prior is as wide as the readings: its pull is 1e-12 of the data's.
  EXPECT_LE((found - truth).norm(), 1e-9);
  EXPECT_LT(estimator.cost(readings - per_state * found, found),
            estimator.cost(readings, Eigen::VectorXd::Zero(2)));
}

/// Both states by which one reading at the first sample could be explained.
TEST(InitialState, IsBoundedByItsPriorWhereStatesCancel) {
  Eigen::MatrixXd per_state = decaying();
  per_state.col(1) = per_state.col(0) * (1.0 + 1e-12);
  Eigen::VectorXd readings = Eigen::VectorXd::Zero(50);
  readings(7) = 1.0;
  const InitialStateEstimator estimator(per_state, Eigen::VectorXd::Constant(50, 1e-3), readings);
  const Eigen::VectorXd found = estimator.step(readings, Eigen::VectorXd::Zero(2));
  EXPECT_LE(found.cwiseAbs().maxCoeff(), 1.0);
}

TEST(InitialState, ThatNoReadingShowsHasAFinitePrior) {
  Eigen::MatrixXd per_state = decaying();
  per_state.col(1).setZero();
  const Eigen::VectorXd prior =
      prior_of_state(per_state, Eigen::VectorXd::Ones(50), Eigen::VectorXd::Ones(50));
  EXPECT_TRUE(prior.allFinite());
  EXPECT_NEAR(prior(1) * kLeastShown, prior(0), 1e-12 * prior(0));
}

/// Strain does not show the angle at which the arm starts.
TEST(InitialState, OfARunThatShowsNoAngleIsFiltered) {
  const std::vector<arm::Sensor> sensors = {arm::parse_sensor("strain@0.05")};
  response::ArmParts parts = response::take_apart(trial_arm());
  parts.disturbance = response::HubDisturbance{0.05};
  const response::ArmSimulator simulation(
      response::time_model(response::make_formulation("exact_tf", parts.linear, 4), parts, 4,
                           sensors),
      parts, sensors, response::options_of_fit(2e-3, response::TorqueHold::zero));
  std::vector<double> torque_N_m;
  for (int k = 0; k < 500; ++k) torque_N_m.push_back(0.05 * std::sin(0.1 * k));
  const Eigen::VectorXd strain = simulation.readings(torque_N_m).reshaped();
  const double deviation = 1e-3 * strain.cwiseAbs().maxCoeff();
  const RecordedRun recorded{
      torque_N_m, strain, Eigen::VectorXd::Constant(1, deviation), {0.01}, true};
  const RunFilter filter =
      run_filter(simulation, simulation.sampled(recorded.process, recorded.deviations), recorded);
  const RunInnovations run = filter_run(simulation, recorded, filter);
  ASSERT_TRUE(run.standardised.allFinite());
  EXPECT_TRUE(std::isfinite(run.log_determinant));
  // Without noise the innovations of the true arm are far below their deviation.
  EXPECT_LE(run.standardised.cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace flexarm::diagnose
