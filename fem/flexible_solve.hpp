#pragma once

#include "fem/discretisation.hpp"
#include "fem/static_flexibility.hpp"

#include <Eigen/Core>

namespace flexarm::fem {

/// What holds the hub while the arm vibrates.
enum class HubSupport {
  free,     ///< nothing: the poles
  clamped,  ///< theta = 0: the zeros of a collocated sensor
};

/// A displacement, n, and the natural deformations that it came from, n - 1.
struct Deformed {
  Eigen::VectorXd u;
  Eigen::VectorXd d;
};

/// K^-1 on the flexible subspace, in all n coordinates, dimensionless. An object serves one thread
/// at a time and must not outlive the discretisation.
class FlexibleSolve {
 public:
  FlexibleSolve(const Discretisation& model, HubSupport support);

  const StaticFlexibility& flexibility() const { return flexibility_; }

  /// Loads less the part that accelerates the rigid arm: f - M r (r^T f)/(r^T M r).
  Eigen::VectorXd self_equilibrated(const Eigen::VectorXd& f) const;
  /// The response to the loads `f`, n, that is M-orthogonal to the rigid rotation; of the clamped
  /// arm that with theta = 0.
  Deformed operator()(const Eigen::VectorXd& f) const;

 private:
  const Discretisation& model_;
  HubSupport support_;
  StaticFlexibility flexibility_;
};

}  // namespace flexarm::fem
