#pragma once

#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"

#include <vector>

namespace flexarm::assumed_modes {

/// A spring to ground and an inertia that act on one displacement or rotation, row . q.
struct Lumped {
  Vector row;
  Real inertia = 0;
  Real stiffness = 0;
};

/// Lagrange's equations of the undamped arm, (K + sigma^2 M) q = a tau, over m l^3 and EI/l, in
/// parts: what is lumped may be 1e9 times what is spread, and is kept apart until nothing can
/// cancel.
///
///     K = diag(strain) + gravity + sum stiffness row row^T,   M = spread + sum inertia row row^T
struct SymmetricPencil {
  Vector strain;               ///< n
  Matrix gravity;              ///< n x n; empty where there is none
  Matrix spread;               ///< mass of the beam, n x n
  /// What the torque acts on, rotor or hub; the hub beyond a drive, payload's mass, payload's
  /// inertia, masses on the beam.
  std::vector<Lumped> lumped;

  Eigen::Index size() const { return strain.size(); }
  /// K and M, symmetric to the last bit.
  Matrix stiffness() const;
  Matrix mass() const;
};

/// The arm on admissible functions, the rigid rotation first. Energies of arm/linear_arm.hpp; the
/// payload's mass acts on y(1) + offset psi(1), its centre, and its own inertia on psi(1).
SymmetricPencil equations_of(const AdmissibleFunctions& functions, const ScaledArm& arm);

/// The pencil on functions less a share of the rigid rotation: q_0 = -share . (q_1, q_2, ...).
struct WithoutRotation {
  SymmetricPencil pencil;  ///< n - 1
  Vector share;            ///< n - 1

  /// Columns over q_1, q_2, ... to columns over all coordinates.
  Matrix in_all_coordinates(const Matrix& vectors) const;
};

/// Functions that are free of rigid-body motion, share = M_0j/M_00, for an arm that turns freely:
/// its flexible modes are combinations of them. With f_0 a row's value in the rotation and b the
/// beam's spread mass, a row is there
///
///     f_i - f_0 M_0i/M_00 = (f_i b_00 - f_0 b_0i + sum_k m_k f_k0 (f_i f_k0 - f_0 f_ki))/M_00,
///
/// in which the row of a great mass m_k does not cancel.
WithoutRotation without_rigid_mode(const SymmetricPencil& pencil);

/// Functions that keep the rotor, or the hub of a rigid drive, from turning; the Ritz values of
/// these are the zeros of the hub angle. `lumped` must begin with it; its inertia and spring drop
/// out.
WithoutRotation with_hub_held(const SymmetricPencil& pencil);

/// 2-norm condition number of `mass` scaled to a unit diagonal: how far the functions are from
/// being independent.
double scaled_condition_number(const Matrix& mass);

}  // namespace flexarm::assumed_modes
