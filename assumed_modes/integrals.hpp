#pragma once

#include "assumed_modes/real.hpp"

namespace flexarm::assumed_modes {

/// Integrals over [0, 1] of functions psi_i that vanish at the root (xi = x/l).
struct Integrals {
  Matrix mass;    ///< int psi_i psi_j
  Vector moment;  ///< int xi psi_i
  Vector mean;    ///< int psi_i
};

}  // namespace flexarm::assumed_modes
