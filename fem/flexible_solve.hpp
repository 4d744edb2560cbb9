#pragma once

#include "fem/discretisation.hpp"
#include "fem/hub_driven_response.hpp"
#include "fem/static_flexibility.hpp"

#include <Eigen/Core>

#include <optional>

namespace flexarm::fem {

/// What holds the hub while the arm vibrates.
enum class HubSupport {
  free,     ///< its own spring and weight, or nothing: the poles
  clamped,  ///< u(0) = 0: the zeros of a collocated sensor
};

/// A displacement and the natural deformations that it came from.
using Deformed = ShapeOf<double>;

/// (K + shift M)^-1 in all n coordinates, dimensionless; of an arm that turns freely on the
/// flexible subspace, with shift 0. An object serves one thread at a time and must not outlive the
/// discretisation.
///
/// Without weight, with the hub clamped or free, the shift is 0 and the solution one by statics and
/// kinematics (see StaticFlexibility). Otherwise it is by LU in mixed form (see HubDrivenResponse),
/// shifted by an eighth of the lowest flexible eigenvalue there would be without weight and hub
/// spring: a hub that next to nothing holds then leaves the flexible modes their digits. An arm
/// that stands up has a shift with which no eigenvalue is negative.
class FlexibleSolve {
 public:
  FlexibleSolve(const Discretisation& model, HubSupport support);

  double shift() const { return shift_; }
  /// The response is M-orthogonal to the rigid rotation.
  bool leaves_out_rigid_rotation() const { return !shifted_ && support_ == HubSupport::free; }
  const StaticFlexibility& flexibility() const { return flexibility_; }

  /// Loads less the part that accelerates the rigid arm: f - M r (r^T f)/(r^T M r).
  Eigen::VectorXd self_equilibrated(const Eigen::VectorXd& f) const;
  /// The response to the loads `f`, n; of the clamped arm that with u(0) = 0.
  Deformed operator()(const Eigen::VectorXd& f) const;

 private:
  Deformed unshifted(const Eigen::VectorXd& f) const;
  double flexible_estimate() const;

  const Discretisation& model_;
  HubSupport support_;
  StaticFlexibility flexibility_;
  double shift_ = 0.0;
  struct Shifted {
    HubDrivenResponse<double> response;
    Deformed turned;
  };
  std::optional<Shifted> shifted_;
};

}  // namespace flexarm::fem
