#include "fem/flexible_solve.hpp"

#include "fem/standing_arm.hpp"

#include <cmath>
#include <utility>

namespace flexarm::fem {

FlexibleSolve::FlexibleSolve(const Discretisation& model, HubSupport support)
    : model_(model), support_(support), flexibility_(model) {
  const bool free = support == HubSupport::free;
  if (!model.has_weight() && (!free || model.turns_freely())) return;
  constexpr double kPart = 1.0 / 8.0;
  shift_ = kPart * flexible_estimate();
  if (model.arm().gravity_m_per_s2 < 0.0) {
    shift_ = shift_of_standing_arm(model.arm(), free ? 0 : 1, shift_);
  }
  HubDrivenResponse<double> response(model, undamped_dynamics(model, shift_));
  Deformed turned = response.to_unit_rotation();
  shifted_.emplace(Shifted{std::move(response), std::move(turned)});
}

double FlexibleSolve::flexible_estimate() const {
  constexpr int kSteps = 4;
  Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(model_.size(), 1.0, 7919.0).array().sin();
  double quotient = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    const Deformed next = unshifted(model_.mass() * u);
    const double square = next.u.dot(model_.mass() * next.u);
    quotient = next.d.cwiseAbs2().dot(model_.natural_stiffness()) / square;
    u = next.u / std::sqrt(square);
  }
  return quotient;
}

Eigen::VectorXd FlexibleSolve::self_equilibrated(const Eigen::VectorXd& f) const {
  if (support_ == HubSupport::clamped) return f;
  const double angular = model_.rigid_rotation().dot(f) / model_.total_inertia();
  return f - angular * model_.rigid_momentum();
}

Deformed FlexibleSolve::unshifted(const Eigen::VectorXd& f) const {
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

Deformed FlexibleSolve::operator()(const Eigen::VectorXd& f) const {
  if (!shifted_) return unshifted(f);
  return support_ == HubSupport::clamped
             ? shifted_->response.to_loads(f)
             : shifted_->response.to_loads_of_free_arm(f, shifted_->turned);
}

}  // namespace flexarm::fem
