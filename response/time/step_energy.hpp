#pragma once

#include "response/time/modal_dynamics.hpp"

#include <Eigen/Core>

namespace flexarm::response {

/// Work and losses over a step in which the only added force is a constant torque on the hub, which
/// turns or is held all the time: exact for a step of any length, stiff ones included.
///
/// With z = (X, u0, u1 - u0, f, s), z' = M z, a loss is the integral of |C z|^2 and the work that
/// of (tau z)(v z); f is the torque that moves the hub beside the actuator's, s the part of it that
/// is no dry friction. Over a step short enough for Gauss' rule these are |R z|^2 and z^T V z; two
/// steps make one of twice the length by
///
///     R -> the triangle of [R; R e^(M dt)],   V -> V + e^(M dt)^T V e^(M dt).
///
/// R is never multiplied out: fast decay leaves losses that are differences of large numbers, and
/// |R z|^2 has the error of R z only. Losses are 0 or more for any damping; one that creates energy
/// shows as a residual.
class StepEnergy {
 public:
  enum class Hub { turning, held };

  /// `arm` has m = 1.
  StepEnergy(const ModalDynamics& arm, Hub hub, double hub_viscous_friction_N_m_s_per_rad,
             double step_s);

  struct Amounts {
    double work_in_J = 0.0;
    double viscous_J = 0.0;
    double material_air_J = 0.0;
  };
  /// Torque during a step [N m].
  struct Torques {
    double actuator_begin = 0.0;  ///< it goes straight to actuator_end
    double actuator_end = 0.0;
    double added = 0.0;         ///< f, which the motion was solved with
    double added_smooth = 0.0;  ///< s
  };
  /// Of the step that begins at `x`.
  Amounts operator()(const Eigen::VectorXd& x, const Torques& torques) const;

 private:
  Eigen::MatrixXd work_;          ///< V
  Eigen::MatrixXd viscous_;       ///< R of the hub's viscous friction
  Eigen::MatrixXd material_air_;  ///< R of the other linear damping
};

}  // namespace flexarm::response
