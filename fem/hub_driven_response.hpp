#pragma once

#include "fem/discretisation.hpp"
#include "fem/klu_factor.hpp"

#include <Eigen/Core>

#include <complex>

namespace flexarm::fem {

/// A shape of complex amplitudes, n, and its natural deformations, n - 1.
struct DynamicShape {
  Eigen::VectorXcd u;
  Eigen::VectorXcd d;
};

/// The arm at one complex frequency while its hub rotation is prescribed, dimensionless:
///
///     (1 + kv s) K_c u_c + s^2 (M u)_c = f_c,   u(0) = theta given.
///
/// Solved in mixed form, with bending moments and shear forces q of the elements as unknowns
/// beside u, so that no stiffness of order h^-3 is ever added to another:
///
///     B u - ((1 + kv s) D)^-1 q = 0,   B^T q + s^2 M u = f.
///
/// The unknowns are ordered along the arm and eliminated by LU with partial pivoting: a narrow
/// band, in which rounding perturbs only neighbours, so that a response that decays by many
/// orders of magnitude along the arm is accurate relative to its local size.
/// The factor is singular at the zeros of the hub angle. An object serves one thread at a time.
class HubDrivenResponse {
 public:
  using Complex = std::complex<double>;

  /// `stiffness_factor` is 1 + kv s.
  HubDrivenResponse(const Discretisation& discretisation, Complex stiffness_factor,
                    Complex s_squared);

  bool singular() const { return factor_.singular(); }
  /// For theta = 1 and no other load.
  DynamicShape to_unit_rotation() const;
  /// For theta = 0 and the loads `f`, n; f(0) is not used.
  DynamicShape to_loads(const Eigen::VectorXcd& f) const;

 private:
  DynamicShape solve(Eigen::VectorXcd mixed, Complex theta) const;

  const Discretisation& model_;
  Complex stiffness_factor_;
  Complex s_squared_;
  KluFactor<Complex> factor_;
};

/// y of (s^2 M + s C + K) y = f with the hub free, damping included; not finite at a pole.
DynamicShape free_response(const Discretisation& discretisation, std::complex<double> s,
                           const Eigen::VectorXcd& f);

}  // namespace flexarm::fem
