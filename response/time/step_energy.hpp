#pragma once

#include "response/time/modal_dynamics.hpp"

#include <Eigen/Core>

namespace flexarm::response {

/// Work and losses over a step of a turning hub whose only added force is a constant torque on the
/// hub: exact for a step of any length, stiff ones included.
///
/// With z = (X, u0, u1 - u0, f), z' = M z, a loss is the integral of |C z|^2 and the work that of
/// (tau z)(v z). Over a step short enough for Gauss' rule these are |R z|^2 and z^T V z; two steps
/// make one of twice the length by
///
///     R -> the triangle of [R; R e^(M dt)],   V -> V + e^(M dt)^T V e^(M dt).
///
/// R is never multiplied out: fast decay leaves losses that are differences of large numbers, and
/// |R z|^2 has the error of R z only. Losses are 0 or more for any damping; one that creates energy
/// shows as a residual.
class StepEnergy {
 public:
  /// `arm` has m = 1.
  StepEnergy(const ModalDynamics& arm, double hub_viscous_friction_N_m_s_per_rad, double step_s);

  struct Amounts {
    double work_in_J = 0.0;
    double viscous_J = 0.0;
    double material_air_J = 0.0;
  };
  /// Of the step that begins at `x`, its actuator torque going straight from u0 to u1, with this
  /// constant torque on the hub.
  Amounts operator()(const Eigen::VectorXd& x, double u0, double u1, double hub_torque_N_m) const;

 private:
  Eigen::MatrixXd work_;          ///< V
  Eigen::MatrixXd viscous_;       ///< R of the hub's viscous friction
  Eigen::MatrixXd material_air_;  ///< R of the other linear damping
};

}  // namespace flexarm::response
