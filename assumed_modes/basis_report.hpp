#pragma once

#include "arm/arm.hpp"
#include "assumed_modes/basis.hpp"

#include <string>
#include <vector>

namespace flexarm::assumed_modes {

/// A condition that the arm's motion meets and that no function of a basis can meet, because
/// every one of them is zero there.
enum class UnmetCondition {
  root_moment,        ///< y''(0): EI y'' = Ih y'_tt - tau
  tip_moment,         ///< y''(l): EI y'' = -Ip y'_tt
  tip_shear,          ///< y'''(l): EI y''' = Mp y_tt
  root_displacement,  ///< y''''(0): EI y'''' = (P y')' - m y_tt, the beam's equation
  root_rotation,      ///< y'''''(0): EI y''''' = -m y'_tt, the same differentiated
};

/// How one root of the arm converges on one basis.
struct RootConvergence {
  std::string root;                   ///< "pole 3", "hub zero 3"
  std::vector<UnmetCondition> unmet;  ///< slowest first; empty: nothing stands in the way
  /// q of error ~ n^-q by theory; infinite where the error falls faster than any power, or is zero.
  double predicted_order = 0.0;
  /// q by least squares on the series; NaN where fewer than three errors lie above rounding.
  double measured_order = 0.0;
  std::vector<int> functions;          ///< n of the series, ascending
  std::vector<double> relative_error;  ///< of omega, against Legendre functions
  std::string sentence;                ///< all of this for the user
};

/// How a basis converges on an arm, and why.
struct BasisReport {
  Basis basis = Basis::legendre;
  RootConvergence pole;
  RootConvergence hub_zero;
};

/// Says which boundary conditions of this arm the basis does not meet, what order of convergence
/// follows, and what order a series of n shows for the given pole and hub zero.
///
/// The coefficient of y on a shape psi_i of frequency lambda_i, both in strain energy, is by parts
///
///     c_i (1 - mu/lambda_i^4) = [y'' psi_i' - y''' psi_i]
///         + mu/lambda_i^4 [y psi_i''' - y' psi_i'']
///
/// between the ends, with y'''' = mu y. With unit strain energy psi_i ~ 1/lambda_i^2, so that a
/// moment the shapes lack leaves c_i ~ 1/lambda_i, a shear 1/lambda_i^2, and the hub's turning
/// 1/lambda_i^4; a root that moves, or tension, 1/lambda_i^3, as does what a payload off its place
/// or under gravity asks of shapes that carry it, whose tip hardly moves. A Ritz value's error is
/// the sum of c_i^2 beyond n: order 2 p - 1 for c_i ~ i^-p
/// ([StrangFix1973], ch. 6).
///
/// 1 <= root <= 8. Throws InputError for an invalid arm or one that the basis cannot represent.
BasisReport describe_convergence(const arm::Arm& arm, Basis basis, int root = 3);

}  // namespace flexarm::assumed_modes
