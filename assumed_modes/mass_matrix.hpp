#pragma once

#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/integrals.hpp"
#include "assumed_modes/real.hpp"

namespace flexarm::assumed_modes {

/// Mass matrix of y/l = q_0 xi + sum q_i psi_i(xi) over m l^3, in blocks. The stiffness matrix over
/// EI/l is diag(0, 1, ..., 1), since the psi_i are orthonormal in strain energy.
struct MassMatrix {
  Real rigid = 0;   ///< I_T/(m l^3)
  Vector coupling;  ///< of xi with psi_i
  Matrix flexible;  ///< of psi_i with psi_j

  /// The flexible block for functions freed of rigid-body motion, psi_i - xi coupling_i/rigid:
  /// flexible - coupling coupling^T/rigid.
  Matrix without_rigid_mode() const;
  /// All blocks in one; the rigid rotation comes first.
  Matrix assembled() const;
};

MassMatrix mass_matrix(const Integrals& integrals, const InertiaRatios& ratios);

/// 2-norm condition number of `mass` scaled to a unit diagonal: how far the functions are from
/// being independent.
double scaled_condition_number(const MassMatrix& mass);

}  // namespace flexarm::assumed_modes
