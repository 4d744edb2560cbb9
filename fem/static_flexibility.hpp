#pragma once

#include "fem/discretisation.hpp"
#include "fem/klu_factor.hpp"

#include <Eigen/Core>

namespace flexarm::fem {

/// K^-1 of the clamped arm without weight in factors, K^-1 = B^-1 D^-1 B^-T: statics, then
/// elasticity, then kinematics. B is block triangular with blocks of order two at most, so each
/// step is a substitution, and the error does not grow with the condition of K, which is of order
/// h^-4. An object serves one thread at a time.
class StaticFlexibility {
 public:
  explicit StaticFlexibility(const Discretisation& discretisation);

  /// Natural deformations d = D^-1 B^-T f under the loads `f`, n - 1.
  Eigen::VectorXd deformations(Eigen::VectorXd f) const;
  /// Clamped coordinates u = B^-1 d, n - 1.
  Eigen::VectorXd displacements(Eigen::VectorXd d) const;
  const Eigen::VectorXd& natural_stiffness() const { return natural_stiffness_; }

 private:
  KluFactor<double> kinematics_;
  Eigen::VectorXd natural_stiffness_;
};

}  // namespace flexarm::fem
