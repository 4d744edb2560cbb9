#pragma once

#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>
#include <Eigen/QR>

namespace flexarm::compare {

/// Prior standard deviations of an unknown initial state: what each state adds to the readings is
/// about as large as the readings themselves. `per_state` is the change of the readings, sample by
/// sample and sensor by sensor in a column, a column a state; `deviations` those of the readings,
/// `measured` their sizes. A state that shows less than `kLeastShown` of what shows most is taken
/// to show that, so that its deviation is finite.
Eigen::VectorXd prior_of_state(const Eigen::MatrixXd& per_state, const Eigen::VectorXd& deviations,
                               const Eigen::VectorXd& measured);
inline constexpr double kLeastShown = 1e-9;

/// Estimates the initial state of a run by weighted least squares with that prior. Without it,
/// states that decay within a few samples would take any value.
class InitialStateEstimator {
 public:
  /// Arguments as of prior_of_state.
  InitialStateEstimator(const Eigen::MatrixXd& per_state, const Eigen::VectorXd& deviations,
                        const Eigen::VectorXd& measured);

  /// The change of `state` that brings what is `left` of the readings (measured minus predicted
  /// from that state) nearest to 0, of the prior's squares included.
  Eigen::VectorXd step(const Eigen::VectorXd& left, const Eigen::VectorXd& state) const;
  /// Sum of squares that `step` makes least.
  double cost(const Eigen::VectorXd& left, const Eigen::VectorXd& state) const;

 private:
  Eigen::VectorXd prior_;       // deviations of the states: what is solved for is relative to them
  Eigen::VectorXd deviations_;  // of the readings
  Eigen::HouseholderQR<Eigen::MatrixXd> solver_;  // of full rank by the prior
};

}  // namespace flexarm::compare
