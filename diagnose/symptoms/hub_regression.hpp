#pragma once

#include "diagnose/symptoms/hub_motion.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// A torque on the hub [N m] at the samples of each motion.
using HubTorques = std::vector<std::vector<double>>;

/// The residuals of all hub signals, and what a torque on the hub makes of them. Laws of hub torque
/// are evaluated at the measured motion: whatever their form, the arm answers them linearly, and
/// the simulation may have gone another way. In a run with an unknown initial state the
/// least-squares line through each signal is taken out of both: another initial angle and velocity
/// of a free hub would change the signals by such a line.
class HubRegression {
 public:
  /// `motions` must outlive the object.
  explicit HubRegression(const std::vector<HubMotion>& motions);

  const std::vector<HubMotion>& motions() const { return motions_; }
  /// Of all motions and their readings, in standard deviations of the noise.
  const Eigen::VectorXd& residuals() const { return residuals_; }
  /// Of the residuals of a problem those of these signals, in the order and units of residuals().
  Eigen::VectorXd of_hub(const Eigen::VectorXd& of_problem) const;
  /// What these torques, one of each motion, make of the signals, in the order and units of the
  /// residuals.
  Eigen::VectorXd readings(const HubTorques& torques) const;
  /// The product of `signals`, in the order of the residuals, with the transposed matrix of
  /// `readings`: a value a sample of each motion, one motion after the other.
  Eigen::VectorXd adjoint(Eigen::VectorXd signals) const;
  /// Independent numbers among `left`: n (1 - r)/(1 + r) of each signal.
  double independent(const Eigen::VectorXd& left) const;
  /// Residual torque of each run from `left` of the residuals, by its first hub signal.
  HubTorques torques(const Eigen::VectorXd& left) const;

 private:
  /// Of `signals` in the order of the residuals: the lines of runs with an unknown initial state.
  void take_out_initial_motion(Eigen::VectorXd& signals) const;

  const std::vector<HubMotion>& motions_;
  Eigen::VectorXd residuals_;
};

/// A value at the k-th sample as a torque has it: of one that is held to the next sample the mean
/// of both, of what is linear between them.
double at_sample(const HubMotion& motion, const std::vector<double>& values, std::size_t k);

/// The same of the sign of the velocity, which is not known within its noise: a hub at rest would
/// else have signs at random.
double sign_at_sample(const HubMotion& motion, std::size_t k);

}  // namespace flexarm::diagnose
