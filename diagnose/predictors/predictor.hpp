#pragma once

#include "arm/deadline.hpp"
#include "diagnose/experiment.hpp"
#include "diagnose/observations.hpp"
#include "diagnose/predictors/arm_responses.hpp"
#include "diagnose/predictors/filtered_run.hpp"
#include "diagnose/predictors/last_kept.hpp"
#include "diagnose/predictors/modal_models.hpp"
#include "diagnose/predictors/noise_model.hpp"
#include "diagnose/predictors/run_filters.hpp"
#include "diagnose/predictors/torque_balance.hpp"
#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// As the simulation names what the torque does between samples.
response::TorqueHold simulated_hold(measured::TorqueHold hold);

/// What an arm should have shown in the runs of an experiment, by one of four models of `time`
/// runs:
///
/// - output error: the torque alone drives the arm from its initial state, or in closed loop, where
///   the run states its controller, the reference alone drives both;
/// - driven by motion, in an experiment that is (driven_by_motion): the hub turns as measured, and
///   what acts on it has no influence;
/// - torque balance at the hub, in an experiment that judges the torque besides (balanced_at_hub):
///   the recorded torque and what is missing for the motion (BalancedRun). That is relative to the
///   torque that reaches the hub: a gain near 0, or a dead zone above all of it, would leave
///   nothing to balance;
/// - stochastic grey box, with a noise model, for runs that state no controller: a Kalman filter
///   predicts each sample from all samples before it [Kristensen2004].
class Predictor {
 public:
  /// `flexible_modes` move in a simulated run, which is stepped as response::options_of_fit where
  /// forces are not linear; poles, zeros and frequency responses are exact. A run from an unknown
  /// state begins in the most likely one. `experiment` must outlive the object.
  /// After the deadline what evaluates a run throws arm::Cancelled, this constructor with a noise
  /// model included.
  Predictor(const Experiment& experiment, const Observations& observations, int flexible_modes,
            std::optional<NoiseModel> noise = {}, const arm::Deadline& deadline = {});

  /// What the arm shows by output error: one number for each of the experiment's `Observations`,
  /// run after run, of those `runs` alone; the others are 0. `arm` is the experiment's with
  /// effects; each run sets its own payload. What a `time` run showed last is kept: the same arm is
  /// not simulated again at once. Throws InputError for an arm that cannot be computed. Concurrent
  /// calls are safe.
  Eigen::VectorXd operator()(const arm::Arm& arm, const std::vector<bool>& runs) const;

  /// Measured minus predicted in standard deviations; those of other runs mean nothing. With a
  /// noise model the innovations of `time` runs, independent of each other, times
  ///
  ///     (|S|/|S_0|)^(1/(2 n))
  ///
  /// for the n readings of a run that are not left out, S the covariance of their innovations by
  /// `arm` and S_0 that by the experiment's arm: the arm that makes their squares least is the most
  /// likely one where the scale of all noise is free.
  Eigen::VectorXd residuals(const arm::Arm& arm, const std::vector<bool>& runs) const;

  /// By a noise model, which need not be the predictor's: of each of these `time` runs; empty for
  /// others.
  std::vector<RunInnovations> innovations(const arm::Arm& arm, const std::vector<bool>& runs,
                                          const NoiseModel& noise) const;

  /// By the noise model, which the predictor must have: what the filter of each of these `time`
  /// runs predicts ahead, measured minus predicted; `starts` are one a run.
  std::vector<response::ErrorsAhead> errors_ahead(
      const arm::Arm& arm, const std::vector<bool>& runs,
      const std::vector<response::StartsAhead>& starts) const;

  /// Returns the balance of the hub's torque in a `time` run of an experiment that is driven by
  /// motion. Throws InputError for an arm that has none.
  BalancedRun balanced(const arm::Arm& arm, std::size_t run) const;

  int flexible_modes() const { return flexible_modes_; }
  const std::optional<NoiseModel>& noise() const { return noise_; }
  const arm::Deadline& deadline() const { return deadline_; }
  void set_deadline(const arm::Deadline& deadline) { deadline_ = deadline; }

 private:
  /// Runs that one simulation serves.
  struct Condition {
    arm::Payload payload;
    std::vector<arm::Sensor> sensors;
    response::SimulationOptions options;
    bool is_in_closed_loop = false;
    std::vector<std::size_t> runs;
  };
  /// One a run, by the arm.
  using KeptReadings = std::deque<LastKept<arm::Arm, Eigen::VectorXd>>;
  using UseSimulation = std::function<void(std::size_t run, const response::ArmSimulator&)>;

  /// With a disturbance of the hub torque where there is `noise`. `use` is called concurrently.
  void for_each_time_run(const arm::Arm& arm, const std::vector<bool>& runs,
                         const NoiseModel* noise, const UseSimulation& use) const;
  void predict_torques(const arm::Arm& arm, const std::vector<bool>& runs,
                       Eigen::VectorXd& values) const;
  void predict_other_runs(const arm::Arm& arm, const std::vector<bool>& runs,
                          Eigen::VectorXd& values) const;
  /// A `time` run with the readings' deviations by `noise`; it refers to this object.
  RecordedRun recorded(std::size_t run, const NoiseModel& noise) const;
  /// Index of the channel of a `time` run that shows the hub's motion, its angle before its
  /// velocity; empty without any.
  std::optional<Eigen::Index> hub_sensor(std::size_t run) const;
  /// Where a run begins in Observations, and how many numbers it has.
  std::pair<Eigen::Index, Eigen::Index> stretch(std::size_t run) const;
  /// Returns `stretch` without a torque that is judged by the motion.
  std::pair<Eigen::Index, Eigen::Index> simulated_stretch(std::size_t run) const;

  const Experiment* experiment_;
  int flexible_modes_;
  Observations observations_;
  std::optional<NoiseModel> noise_;
  arm::Deadline deadline_;
  // Copies share these.
  std::shared_ptr<ModalModels> models_;
  std::shared_ptr<RunFilters> filters_;
  std::shared_ptr<ArmResponses> responses_;
  std::shared_ptr<KeptReadings> shown_;
  std::vector<Condition> conditions_;     // of `time` runs
  std::vector<double> log_determinants_;  // ln |S_0| of each run, with a noise model
};

/// Flexible modes that move in simulated runs, and the error of leaving the others out.
struct ModeChoice {
  int flexible_modes = 0;
  /// Of each channel, root mean square over the deviation of the signal; 0 but in `time` runs.
  std::vector<double> errors = {};
};

/// The fewest modes with which the simulated runs are within `kModeError` of a signal's deviation,
/// or a tenth of its noise if that is more, of those with `kMostModes`; these where none suffice.
/// The errors are those, or response::truncation_in_time where that is more.
/// At the deadline the number tried last, with its errors; kFewestModes without any where there is
/// none.
ModeChoice modes_needed(const Experiment& experiment, const Observations& observations,
                        const arm::Deadline& deadline = {});
inline constexpr double kModeError = 1e-4;
inline constexpr int kFewestModes = 4;
inline constexpr int kMostModes = 16;

/// Returns what the error of the motion (MeasuredMotion::error) adds to what the arm as filed
/// shows, of an experiment that is driven by motion: a value a number of the observations, in its
/// unit; 0 of an arm that cannot be computed, and after the deadline.
Eigen::VectorXd change_by_motion_error(const Experiment& experiment,
                                       const Observations& observations, int flexible_modes,
                                       const arm::Deadline& deadline);
/// Returns the root mean square of that over the deviation of the measured signal, one a channel.
std::vector<double> errors_of_motion(const Experiment& experiment, const Observations& observations,
                                     int flexible_modes, const arm::Deadline& deadline = {});

}  // namespace flexarm::diagnose
