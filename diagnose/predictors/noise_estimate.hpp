#pragma once

#include "diagnose/predictors/predictor.hpp"

#include <functional>
#include <vector>

namespace flexarm::diagnose {

/// A noise model with what it was found by.
struct NoiseEstimate {
  NoiseModel model;
  double minus_two_log_likelihood = 0.0;  ///< of the runs' innovations, without n ln 2 pi
  int evaluations = 0;                    ///< of that; 0: not run
};

/// Root mean square of the filter's estimates of the disturbance in `time` runs; 0 without any,
/// infinite for an arm that cannot be computed.
double estimated_disturbance_N_m(const Predictor& predictor, const arm::Arm& arm,
                                 const std::vector<bool>& runs, const NoiseModel& noise);

/// Estimates noise models of `time` runs for an arm by maximum likelihood.
class NoiseEstimator {
 public:
  /// `go_on` is called before each evaluation of the likelihood, and may throw to cancel. The
  /// references must outlive the object.
  NoiseEstimator(const Experiment& experiment, const Observations& observations,
                 const Predictor& predictor, std::function<void()> go_on = {});

  /// Over the disturbance's deviation and correlation time, and one reading factor a sensor, by
  /// Subplex [Rowan1990] from `starts` or, without any, from `kCorrelationStarts`. Throws
  /// InputError for an arm that cannot be computed.
  NoiseEstimate model(const arm::Arm& arm, const std::vector<bool>& runs,
                      const std::vector<NoiseModel>& starts = {}) const;
  /// `found`, or with forces on the flexible modes beside it where these lower -2 ln L by
  /// `kLeastModalGain` or more.
  NoiseEstimate with_modal_force(const arm::Arm& arm, const std::vector<bool>& runs,
                                 const NoiseEstimate& found) const;
  /// Over the disturbance's deviation alone, the rest as in `shared`, by Brent's method.
  NoiseEstimate disturbance(const arm::Arm& arm, const std::vector<bool>& runs,
                            const NoiseModel& shared) const;

  /// Root mean square of the commanded torque of all `time` runs.
  double torque_rms_N_m() const { return torque_rms_N_m_; }

 private:
  double minus_two_log_likelihood(const arm::Arm& arm, const std::vector<bool>& runs,
                                  const NoiseModel& model) const;
  /// As `model` by Subplex from each of `starts`; over the modal forces too where the first of them
  /// has some.
  NoiseEstimate searched(const arm::Arm& arm, const std::vector<bool>& runs,
                         const std::vector<NoiseModel>& starts) const;
  /// The most likely value of one number of `shared` by Brent's method, in the bounds of the
  /// disturbance's deviation.
  NoiseEstimate along(double NoiseModel::*number, const arm::Arm& arm,
                      const std::vector<bool>& runs, const NoiseModel& shared) const;
  NoiseModel model_at(const std::vector<double>& logarithms) const;
  std::vector<double> place_of(const NoiseModel& model) const;

  const Predictor* predictor_;
  std::function<void()> go_on_;
  double torque_rms_N_m_ = 0.0;
  double period_s_ = 0.0;
  std::vector<std::string> sensors_;
  // Bounds of the logarithms: deviation, correlation time, factors of the sensors, and behind them
  // the force on the modes.
  std::vector<double> lower_;
  std::vector<double> upper_;
};
/// A parameter more that is worth a delta BIC of 10 in 10^4 to 10^5 samples.
inline constexpr double kLeastModalGain = 20.0;
/// Correlation times to start from, in sampling periods.
inline constexpr double kCorrelationStarts[] = {2.0, 50.0, 1000.0};

}  // namespace flexarm::diagnose
