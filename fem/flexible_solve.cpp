#include "fem/flexible_solve.hpp"

namespace flexarm::fem {

FlexibleSolve::FlexibleSolve(const Discretisation& model, HubSupport support)
    : model_(model), support_(support), flexibility_(model) {}

Eigen::VectorXd FlexibleSolve::self_equilibrated(const Eigen::VectorXd& f) const {
  if (support_ == HubSupport::clamped) return f;
  const double angular = model_.rigid_rotation().dot(f) / model_.total_inertia();
  return f - angular * model_.rigid_momentum();
}

Deformed FlexibleSolve::operator()(const Eigen::VectorXd& f) const {
  Deformed result;
  result.d = flexibility_.deformations(self_equilibrated(f).tail(model_.clamped_size()));
  result.u.resize(model_.size());
  result.u[0] = 0.0;
  result.u.tail(model_.clamped_size()) = flexibility_.displacements(result.d);
  if (support_ == HubSupport::free) {
    const double angle = model_.rigid_momentum().dot(result.u) / model_.total_inertia();
    result.u -= angle * model_.rigid_rotation();
  }
  return result;
}

}  // namespace flexarm::fem
