#pragma once

#include "diagnose/experiment.hpp"
#include "diagnose/observations.hpp"
#include "diagnose/planning/measurement_plan.hpp"
#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// Runs that have not been made, in the form in which those that have are held against a candidate:
/// all but the numbers that will be measured, which an arm predicts.
class PlannedExperiment {
 public:
  /// Every run has a purpose: as `split_purposes` gives it where the plan does not. The sizes of
  /// the effects `unknown` are not known: they are fitted in any case. Throws InputError for an arm
  /// that cannot be computed, or cannot carry a sensor, and for an unknown that these runs cannot
  /// show or that has no size.
  PlannedExperiment(const arm::Arm& arm, std::vector<PlannedRun> runs,
                    const std::vector<std::string>& unknown = {});
  PlannedExperiment(const PlannedExperiment&) = delete;
  PlannedExperiment& operator=(const PlannedExperiment&) = delete;

  const Experiment& experiment() const { return experiment_; }
  /// What `split_purposes` did, or nothing.
  const std::string& notice() const { return notice_; }

  /// Data without noise of an arm whose predictions are `values`, and the noise that is planned.
  Observations observations(const Eigen::VectorXd& values) const;
  /// The problem of finding out about an arm that makes these data; the object must outlive it.
  Problem problem(const Eigen::VectorXd& values) const;
  /// The same of the arm as its file has it.
  const Problem& as_described() const { return as_described_; }

  /// The unknown effects where they do nothing.
  const Candidate& unknowns() const { return unknowns_; }
  /// The change of the data that a candidate makes, in standard deviations, of the estimation runs,
  /// less what the unknowns take of it when they are refitted (to first order); empty where it
  /// cannot be computed.
  std::optional<Eigen::VectorXd> change_by(const Candidate& candidate) const;

 private:
  Problem problem_of_the_arm();
  /// Gives the `time` runs of the experiment these readings.
  void fill_in(const Eigen::VectorXd& values);

  std::string notice_;
  Experiment experiment_;
  std::vector<PlannedRun> runs_;
  Observations layout_;  // with values and deviations of nothing
  ProblemOptions options_;
  Problem as_described_;
  Candidate unknowns_;
  Eigen::MatrixXd taken_;  // orthonormal directions that the unknowns take
};

}  // namespace flexarm::diagnose
