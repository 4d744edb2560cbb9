#pragma once

#include "diagnose/observations.hpp"
#include "diagnose/predictors/predictor.hpp"
#include "diagnose/search/candidate.hpp"
#include "diagnose/search/misfit.hpp"
#include "diagnose/search/policy.hpp"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace flexarm::diagnose {

struct ProblemOptions {
  std::optional<int> flexible_modes = {};  ///< of simulated runs; as many as needed unless given
  /// Of `time` runs: stochastic grey box with it, output error without.
  std::optional<NoiseModel> noise = {};
  Policy policy = {};
  /// Ends its evaluations (Predictor); those that choose the modes end half-way to it.
  arm::Deadline deadline = {};
};

/// An experiment with all that is needed to hold a candidate against it.
class Problem {
 public:
  /// `experiment` must outlive the object.
  explicit Problem(const Experiment& experiment, const ProblemOptions& options = {});
  /// With an experiment that the object keeps.
  Problem(std::shared_ptr<const Experiment> experiment, const ProblemOptions& options);
  /// With other standard deviations than those that the data show (`observe`).
  Problem(const Experiment& experiment, Observations observations,
          const ProblemOptions& options = {});
  Problem(std::shared_ptr<const Experiment> experiment, Observations observations,
          const ProblemOptions& options);

  const Experiment& experiment() const { return *experiment_; }
  const Observations& observations() const { return observations_; }
  const Predictor& predictor() const { return predictor_; }
  const Policy& policy() const { return policy_; }
  const std::vector<bool>& estimation_runs() const { return estimation_runs_; }
  const std::vector<bool>& validation_runs() const { return validation_runs_; }
  bool has_validation_runs() const;
  /// What a choice between models is judged by: the validation runs, or without any those for
  /// estimation.
  const std::vector<bool>& judged_runs() const;
  /// NRMSE of an arm on the judged runs (Misfit::relative_error); infinite for one that cannot be
  /// computed.
  double judged_error(const arm::Arm& arm) const;

  /// By output error from recorded torques.
  bool is_driven_by_torque() const {
    return !predictor_.noise() && !has_controllers(*experiment_) &&
           !is_driven_by_motion(*experiment_);
  }

  /// The same simulated with so many modes, or by a filter.
  Problem with_modes(int flexible_modes) const;
  Problem with_noise(const NoiseModel& noise) const;
  /// The same with another deadline of its evaluations, or none.
  Problem until(const arm::Deadline& deadline) const;

  /// The same with what `experiment`, which the object keeps, has for torques.
  void replace_torques(Experiment experiment);

  /// Takes the noise of `time` channels down to what is seen of it under the residuals of a
  /// candidate, for all runs, where that is less: a signal that fills the spectrum hides it, what
  /// is left of one does not. Coloured noise stays as it is, and that beside a disturbance of the
  /// hub torque, which estimate_noise takes up. Returns whether the noise of any fell by more than
  /// `kLower` of it; else nothing is changed.
  bool lower_noise(const Candidate& candidate);
  static constexpr double kLower = 0.05;

  /// With a noise model that is of the recorded torques, and what that noise adds to a simulation
  /// (ObservedChannel::torque_error), one a channel.
  Problem with_torque_noise(const NoiseModel& noise, const std::vector<double>& errors) const;
  /// With noise of the channels, beside what they have, of this size over the signal's deviation.
  Problem with_more_noise(const std::vector<double>& more) const;
  /// With the noise of `time` channels that is what a candidate leaves, white or not: its power,
  /// and its autoregression up to order `kMostNoiseOrder`. Empty for a candidate that cannot be
  /// computed. The residuals are those of generalised least squares.
  std::optional<Problem> with_coloured_noise(const Candidate& candidate) const;
  bool has_coloured_noise() const;

  /// With a noise model: takes up the most likely one for a candidate where that is more likely by
  /// more than `kMoreLikely` of -2 ln L. Returns whether it did. `go_on` is called before each
  /// evaluation of the likelihood, and may throw to cancel.
  bool estimate_noise(const Candidate& candidate, std::function<void()> go_on = {});
  static constexpr double kMoreLikely = 2.0;
  /// With a noise model: the disturbance that a candidate leaves in these runs.
  DisturbanceLeft disturbance_left(const Candidate& candidate, const std::vector<bool>& runs) const;

  /// The arm as its file describes it, without effects.
  Candidate as_filed() const;

  /// (measured - predicted)/deviation of the runs' numbers, whitened (observations.hpp); 0 for
  /// those of other runs; behind them the candidate's nuisances, which are what the file says of
  /// the arm's uncertain numbers in standard deviations. Empty where the candidate's arm cannot be
  /// computed. Concurrent calls are safe.
  std::optional<Eigen::VectorXd> residuals(const Candidate& candidate,
                                           const std::vector<bool>& runs) const;
  /// The same of an arm, with the nuisances that it was made with.
  std::optional<Eigen::VectorXd> residuals(const arm::Arm& arm,
                                           const std::vector<double>& nuisances,
                                           const std::vector<bool>& runs) const;
  Eigen::Index residual_count() const;

 private:
  /// Of this experiment and these observations, with the predictor's deadline.
  Predictor predictor_with(int flexible_modes, const std::optional<NoiseModel>& noise) const;

  const Experiment* experiment_;
  std::shared_ptr<const Experiment> own_experiment_;  // where it is not the caller's
  Observations observations_;
  std::vector<bool> estimation_runs_;
  std::vector<bool> validation_runs_;
  Policy policy_;
  Predictor predictor_;
};

}  // namespace flexarm::diagnose
