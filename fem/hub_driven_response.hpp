#pragma once

#include "fem/discretisation.hpp"
#include "fem/klu_factor.hpp"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace flexarm::fem {

/// A shape, n, and its natural deformations, n - 1.
template <class Scalar>
struct ShapeOf {
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> u;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> d;
};

/// The frequency s as the equations of motion have it.
template <class Scalar>
struct Dynamics {
  Scalar w = 0.0;    ///< s^2
  Scalar s = 0.0;    ///< of natural dampings; 0 without damping
  Scalar air = 0.0;  ///< ca s
  Scalar hub = 0.0;  ///< c s + ks
};

/// Without damping.
template <class Scalar>
Dynamics<Scalar> undamped_dynamics(const Discretisation& discretisation, Scalar w) {
  return {w, 0.0, 0.0, discretisation.hub_spring()};
}
Dynamics<std::complex<double>> damped_dynamics(const Discretisation& discretisation,
                                               std::complex<double> s);

/// Where the unknowns of the mixed form below stand.
struct MixedOrder {
  std::vector<int> coordinate;  ///< of each clamped coordinate
  std::vector<int> kinematic;   ///< of each natural deformation's equation; -1: is a coordinate
  int size = 0;
};

/// The arm at one frequency, real or complex, dimensionless,
///
///     (K(s) + ca s A + s^2 M) u = f,   K(s) = B^T D(s) B + (c s + ks) e0 e0^T + G,
///
/// with D(s) = D + s D_c. Solved in mixed form for a prescribed rotation
/// u(0) of the hub or its rotor, with bending moments, shear forces and spring torques q as
/// unknowns beside u, so that no stiffness of order h^-3 is ever added to another:
///
///     B u - D(s)^-1 q = 0,   B^T q + (G + ca s A + s^2 M) u = f,   u(0) given.
///
/// The unknowns are ordered along the arm and eliminated by LU with partial pivoting: a narrow
/// band, in which rounding perturbs only neighbours, so that a response that decays by many
/// orders of magnitude along the arm is accurate relative to its local size.
/// The factor is singular at the zeros of the hub angle. An object serves one thread at a time.
template <class Scalar>
class HubDrivenResponse {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Shape = ShapeOf<Scalar>;

  HubDrivenResponse(const Discretisation& discretisation, const Dynamics<Scalar>& dynamics);

  bool singular() const { return factor_.singular(); }
  /// For u(0) = 1 and no other load.
  Shape to_unit_rotation() const;
  /// For u(0) = 0 and the loads `f`, n; f(0) is not used.
  Shape to_loads(const Vector& f) const;
  /// With the hub free, under the loads `f`, n; `turned` is the response to unit rotation. Not
  /// finite at a pole.
  Shape to_loads_of_free_arm(const Vector& f, const Shape& turned) const;
  /// The torque on the hub in the motion `u` without other loads, by its work on the rigid
  /// rotation. No stress enters, so that nothing cancels as s tends to 0.
  Scalar hub_torque(const Vector& u) const;

 private:
  Shape solve(Vector mixed, Scalar rotation) const;

  const Discretisation& model_;
  Dynamics<Scalar> dynamics_;
  MixedOrder order_;
  KluFactor<Scalar> factor_;
};

extern template class HubDrivenResponse<double>;
extern template class HubDrivenResponse<std::complex<double>>;

/// y of (s^2 M + s C + K) y = f with the hub free, damping included; not finite at a pole.
ShapeOf<std::complex<double>> free_response(const Discretisation& discretisation,
                                            std::complex<double> s, const Eigen::VectorXcd& f);

}  // namespace flexarm::fem
