#pragma once

#include "measured/files/sensor_columns.hpp"

#include <Eigen/Core>

#include <complex>
#include <span>

namespace flexarm::measured {

/// The fitted transfer function from torque to one sensor, with its derivatives to all parameters
/// it has: theta of the blocks, then the sensor's shared beta.
class FittedTransfer {
 public:
  /// `beta`: the first `model.shared` linear parameters.
  FittedTransfer(BlockSet blocks, SensorModel model, Eigen::VectorXd beta);

  Eigen::Index parameters() const { return blocks_.parameters() + beta_.size(); }
  const BlockSet& blocks() const { return blocks_; }
  const SensorModel& model() const { return model_; }
  const Eigen::VectorXd& beta() const { return beta_; }
  /// The same with other parameters.
  FittedTransfer with(const Eigen::VectorXd& parameters) const;
  Eigen::VectorXd values() const;

  std::complex<double> value(std::complex<double> s_rad_per_s) const;
  std::complex<double> s_derivative(std::complex<double> s_rad_per_s) const;
  Eigen::RowVectorXcd gradient(std::complex<double> s_rad_per_s) const;

  /// The power of s that the static remainder has.
  int remainder_power() const { return arm::derivative_order(model_.sensor); }
  /// Zeros at s = 0 that the sensor has whatever the parameters: 1 for an acceleration.
  int zeros_at_origin() const { return arm::derivative_order(model_.sensor) == 2 ? 1 : 0; }

  /// (b1 s + b0)/(s^2 + a1 s + a0), times s^k for a sensor of k derivatives: a block's part as that
  /// of a displacement. Of c0 + c1 s in a velocity, s (b1 s + b0) less b1 (s^2 + a1 s + a0), it is
  /// b1 = -c0/a0, b0 = c1 - a1 c0/a0; of an acceleration the same, a power of s higher.
  struct Numerator {
    double b1 = 0.0;
    double b0 = 0.0;
  };
  Numerator numerator(std::size_t block) const;
  /// Derivatives of b1 (row 0) and b0 to all parameters: 2 x `parameters()`.
  Eigen::Matrix2Xd numerator_gradient(std::size_t block) const;

 private:
  BlockSet blocks_;
  SensorModel model_;
  Eigen::VectorXd beta_;
};

}  // namespace flexarm::measured
