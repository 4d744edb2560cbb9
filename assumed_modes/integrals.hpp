#pragma once

#include "assumed_modes/real.hpp"

namespace flexarm::assumed_modes {

/// What Lagrange's equations need of admissible functions psi_i on [0, 1] (xi = x/l) that are
/// orthonormal in strain energy, int psi_i'' psi_j'' = delta_ij, and vanish at the root.
struct Integrals {
  Matrix mass;        ///< int psi_i psi_j
  Vector moment;      ///< int xi psi_i
  Vector root_slope;  ///< psi_i'(0)
  Vector tip;         ///< psi_i(1)
  Vector tip_slope;   ///< psi_i'(1)
};

}  // namespace flexarm::assumed_modes
