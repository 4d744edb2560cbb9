#pragma once

#include <Eigen/Core>
#include <Eigen/QR>

namespace flexarm::diagnose {

/// (I - J J^+) x: changes x of the residuals without the part that refitting the parameters with
/// the derivatives J makes as well, to first order.
class RefitProjection {
 public:
  explicit RefitProjection(const Eigen::MatrixXd& jacobian) : parameters_(jacobian.cols()) {
    if (parameters_ > 0) derivatives_.compute(jacobian);
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& change) const {
    if (parameters_ == 0) return change;
    Eigen::VectorXd beyond = derivatives_.householderQ().adjoint() * change;
    beyond.head(parameters_).setZero();
    return derivatives_.householderQ() * beyond;
  }

  /// Returns J^+ x: minus the step of the parameters by which a refit answers `change`. Parameters
  /// that the derivatives hardly determine take a step of any size.
  Eigen::VectorXd step(const Eigen::VectorXd& change) const {
    if (parameters_ == 0) return Eigen::VectorXd();
    return derivatives_.solve(change);
  }

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> derivatives_;
  Eigen::Index parameters_;
};

}  // namespace flexarm::diagnose
