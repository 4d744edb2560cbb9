#pragma once

#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>
#include <Eigen/QR>

namespace flexarm::diagnose {

/// Estimates the initial state of a run by weighted least squares, with a prior that bounds it:
/// what each state adds to the readings is about as large as the readings themselves (one standard
/// deviation). Without the prior, states that decay within a few samples would take any value.
class InitialStateEstimator {
 public:
  /// `per_state` is the change of the readings, sample by sample and sensor by sensor in a column,
  /// a column a state; `deviations` those of the readings, `measured` their sizes.
  InitialStateEstimator(const Eigen::MatrixXd& per_state, const Eigen::VectorXd& deviations,
                        const Eigen::VectorXd& measured);

  /// The change of `state` that brings what is `left` of the readings (measured minus predicted
  /// from that state) nearest to 0, of the prior's squares included.
  Eigen::VectorXd step(const Eigen::VectorXd& left, const Eigen::VectorXd& state) const;
  /// Sum of squares that `step` makes least.
  double cost(const Eigen::VectorXd& left, const Eigen::VectorXd& state) const;

 private:
  Eigen::VectorXd scale_;       // of a state: its unit over this is a unit of the scaled one
  Eigen::VectorXd deviations_;  // of the readings
  double prior_ = 0.0;          // 1/deviation of a scaled state
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
};

}  // namespace flexarm::diagnose
