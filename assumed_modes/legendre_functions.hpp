#pragma once

#include "assumed_modes/integrals.hpp"
#include "assumed_modes/real.hpp"

#include <array>

namespace flexarm::assumed_modes {

/// Polynomials psi_k on [0, 1] with psi_k(0) = psi_k'(0) = 0 whose second derivatives are the
/// orthonormal Legendre polynomials sqrt(2k + 1) P_k(2 xi - 1), k = 0, 1, ... The strain energy
/// matrix is the identity. Every end value is left free, so that whatever boundary condition the
/// arm has is met in the limit and the Ritz values converge faster than any power of `count`.
class LegendreFunctions {
 public:
  explicit LegendreFunctions(int count);

  /// Exact: products of Legendre series with at most five terms.
  Integrals integrals() const;
  /// psi, psi' or psi'' (derivative 0, 1, 2) at xi.
  Vector values(Real xi, int derivative) const;

 private:
  /// Row k: Legendre coefficients of psi_k, psi_k', psi_k''; `count` by `count + 2`.
  std::array<Matrix, 3> coefficients_;
};

}  // namespace flexarm::assumed_modes
