#pragma once

#include "response/time/modal_dynamics.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace flexarm::response {

/// The exact solution of a LinearSystem over one step of fixed length, for an actuator torque that
/// goes straight from u0 to u1 and a force that is constant or the parabola through its values
/// f0, fm, f1 at begin, middle and end:
///
///     X(end) = state X + actuator_begin u0 + actuator_end u1 + (force_begin f0 + ...).
struct Propagator {
  Eigen::MatrixXd state;           ///< e^(A dt), N x N
  Eigen::VectorXd actuator_begin;  ///< N
  Eigen::VectorXd actuator_end;
  Eigen::MatrixXd force_begin;  ///< N x m
  Eigen::MatrixXd force_middle;
  Eigen::MatrixXd force_end;

  Eigen::MatrixXd constant_force() const { return force_begin + force_middle + force_end; }
};

/// Up to kMostExtendedRows rows the exponential can be formed in extended precision. The error of
/// e^(A dt), which a long simulation repeats step by step, is then that of rounding each entry
/// once; in working precision it is up to |A dt| times as large, and formed ten times as fast.
enum class Precision { extended, working };

/// From t = 0 to dt. By the exponential of
///
///     [A B 0 0]
///     [0 0 1 0]  dt,   B = (actuator, force),
///     [0 0 0 1]
///     [0 0 0 0]
///
/// whose first row holds e^(A dt) and phi_k(A dt) B dt: t^k/k! of an input adds phi_(k+1). Where
/// the system has it actuator_rate is another column of B.
Propagator propagator(const LinearSystem& system, double step_s,
                      Precision precision = Precision::extended);

/// Of a step, with the inputs defined on all of it.
struct StepPropagators {
  std::optional<Propagator> middle;  ///< from its beginning to its middle
  Propagator end;
};

/// Of steps of `step_s`, of half of it and so on, `halvings` times: the longest first. The
/// exponential is formed for the shortest length and squared for the others: products of matrices
/// in place of exponentials.
std::vector<StepPropagators> halved_propagators(const LinearSystem& system, double step_s,
                                                int halvings, bool with_middle,
                                                Precision precision);

}  // namespace flexarm::response
