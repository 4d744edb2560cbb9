#pragma once

#include "exact_tf/transfer_chain.hpp"

namespace flexarm::exact_tf {

/// Numbers of eigenvalues omega^2 below the chain's; they step with the signs of RootValues.
struct ChainCount {
  int hub_held = 0;  ///< poles with the rotor, or a hub without, held: roots of motor_angle
  int poles = 0;     ///< the lowest mode's included: roots of torque
};

/// The algorithm of [WittrickWilliams1971] on the undamped chain,
/// whose clamped segments do not resonate: the count is that of the negative pivots of the dynamic
/// stiffness, eliminated from the tip to the hub.
///
/// Displacements u = (y, psi) at a segment's right end are eliminated with the pivot
///
///     B = -T_uf^-1 A,   det B = p_left/p_right/det T_uf,
///
/// u_left = T_uu u + T_uf (Q, M), u_left = A u within the plane of states, p its minor of y and
/// psi; det T_uf > 0 below the first clamped resonance. The crack's psi(X+) has the pivot kc
/// p_left/p_right, the extension of a suspension kk D of which p is a multiple beyond it (see
/// CarriedMass), psi(0) at a soft root kr hub_angle/p, the hub angle beyond a soft drive kd
/// motor_angle/hub_angle, the motor's angle torque/motor_angle. Signs of
/// the products telescope, so that the count's parity is that of the sign of the last function, and
/// a sign that rounding turned where a minor all but vanishes is taken back by the next.
template <class R>
ChainCount count_below(const TransferChain<R>& chain);

}  // namespace flexarm::exact_tf
