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
  double begin_s = 0.0;
  double length_s = 0.0;
  Eigen::VectorXd f0;
  Eigen::VectorXd fm;
  Eigen::VectorXd f1;

  double torque(double r) const { return u0 + r * (u1 - u0); }
  double time(double r) const { return begin_s + r * length_s; }
  Eigen::VectorXd force_slope() const { return -3.0 * f0 + 4.0 * fm - f1; }    ///< at r = 0
  Eigen::VectorXd force_square() const { return 2.0 * (f0 - 2.0 * fm + f1); }  ///< of r^2
};

/// Bounds of a reading y = c X + e u + d f over a step, from its values at the ends of `parts`
/// equal parts of it. On one of length h from t_k
///
///     y >= min(y(t_k), y(t_k + h)) - M h^2/8,   M >= |y''|.
///
/// With Z = (X; u0; u1 - u0; f0; f', f'') and Z' = G Z, y = c Z, entry by entry
///
///     |y''| <= |c G^2| e^(|G| h) |e^(G t_k)| |Z(0)|,
///
/// so that values and bounds are rows that multiply Z(0) and |Z(0)|. c may not contain W.
class WatchBound {
 public:
  WatchBound() = default;
  WatchBound(const LinearSystem& system, const Reading& reading, double step_s, int parts);

  int parts() const { return static_cast<int>(sags_.rows()); }
  /// The reading stays above `least` for the whole step; of -reading with `sign` -1.
  bool stays_above(double least, double sign, const Eigen::VectorXd& x0,
                   const StepInputs& inputs) const;

 private:
  Eigen::MatrixXd values_;  ///< parts + 1 rows
  Eigen::MatrixXd sags_;    ///< parts rows
};

/// Everything that is computed once for steps of one length with the hub turning or held.
struct StepTable {
  Propagator end;
  Propagator middle;         ///< only where forces vary
  Eigen::VectorXd constant;  ///< X(end) per unit of a constant torque on the hub, m = 1
  WatchBound watched;
};

/// `watched` may be null: its bound grows as e^(|A| dt/parts), and is not for stiff steps.
StepTable step_table(const LinearSystem& system, const Reading* watched, double step_s, int parts,
                     bool forces_vary, Precision precision);

}  // namespace flexarm::response
