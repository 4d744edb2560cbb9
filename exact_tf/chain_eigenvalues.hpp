#pragma once

#include "arm/formulation.hpp"
#include "exact_tf/beam_units.hpp"

#include <vector>

namespace flexarm::exact_tf {

/// Eigenvalues omega^2 of the undamped arm in units of the beam, ascending, each within rounding of
/// lambda = |omega^2|^(1/4), and all by the count of exact_tf/chain_count.hpp.
struct ChainEigenvalues {
  std::vector<Real> omega_squared;
  arm::RootCount count;
  arm::SolveSummary summary;
};

/// The lowest mode's eigenvalue, 0 for an arm that turns freely, and after it the `count` lowest
/// flexible ones. `count.found` and `count.expected` count flexible ones.
template <class R>
ChainEigenvalues find_chain_poles(const ArmInBeamUnits<R>& arm, int count);

/// The `count` lowest eigenvalues with the rotor held, or the hub where the drive is rigid.
template <class R>
ChainEigenvalues find_chain_hub_zeros(const ArmInBeamUnits<R>& arm, int count);

/// No flexible mode of the arm has a negative eigenvalue; its lowest, of a standing arm that falls,
/// may. Without gravity always true.
bool flexible_modes_are_stable(const ArmInBeamUnits<Real>& arm);

}  // namespace flexarm::exact_tf
