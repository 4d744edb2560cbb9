#pragma once

#include "response/time/modal_dynamics.hpp"
#include "response/time/propagator.hpp"

#include <Eigen/Core>

namespace flexarm::response {

/// What an inner step of the actuator torque and the added forces is made of: in r = t/dt the
/// torque goes straight from u0 to u1, the force is the parabola through f0, fm, f1 at r = 0,
/// 1/2, 1.
struct StepInputs {
  double u0 = 0.0;
  double u1 = 0.0;
  Eigen::VectorXd f0;
  Eigen::VectorXd fm;
  Eigen::VectorXd f1;

  double torque(double r) const { return u0 + r * (u1 - u0); }
  Eigen::VectorXd force_slope() const { return -3.0 * f0 + 4.0 * fm - f1; }    ///< at r = 0
  Eigen::VectorXd force_square() const { return 2.0 * (f0 - 2.0 * fm + f1); }  ///< of r^2
};

/// How far a reading y = c X + d f + e u can leave the straight line between its values at both
/// ends of a step: M dt^2/8 with M >= |y''|. From
///
///     y'' = c A^2 X + c A B u + c B u' + d f'',   |X| <= e^(|A| dt) (|X(0)| + dt |B| |u|)
///
/// entry by entry, u with the forces f in it.
class SagBound {
 public:
  SagBound() = default;
  SagBound(const LinearSystem& system, const Reading& reading, double step_s);

  /// For torque within +-|torque| that changes by `torque_change`, and a constant force on the hub
  /// (m = 1).
  double of_constant(const Eigen::VectorXd& x0, double torque, double torque_change,
                     double force) const {
    return by_state_.dot(x0.cwiseAbs()) + by_torque_ * torque + by_torque_change_ * torque_change +
           by_force_(0) * force;
  }
  double operator()(const Eigen::VectorXd& x0, const StepInputs& inputs) const;

 private:
  Eigen::VectorXd by_state_;
  double by_torque_ = 0.0;
  double by_torque_change_ = 0.0;
  Eigen::VectorXd by_force_;
  Eigen::VectorXd by_force_slope_;
  Eigen::VectorXd by_force_curvature_;
};

/// Everything that is computed once for steps of one length with the hub turning or held.
struct StepTable {
  Propagator end;
  Propagator middle;         ///< only where forces vary
  Eigen::VectorXd constant;  ///< X(end) per unit of a constant torque on the hub, m = 1
  SagBound sag;              ///< of the reading that is watched
};

/// `watched` may be null: its bound grows as e^(|A| dt), and is not for stiff steps.
StepTable step_table(const LinearSystem& system, const Reading* watched, double step_s,
                     bool forces_vary);

}  // namespace flexarm::response
