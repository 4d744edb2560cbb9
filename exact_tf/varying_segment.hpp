#pragma once

#include "exact_tf/bivector.hpp"

namespace flexarm::exact_tf {

/// A plane of states and a functional carried across a segment by power series of their own, which
/// under gravity, where every segment has another transfer matrix, takes a part of the work that
/// the matrix and its compound take. Recursions are those of exact_tf/segment_series.hpp; G and D
/// are linear in the variable of the series.
///
/// The plane p, in u from the right end: with the products w_j of the slope y' and component j,
/// D w_j = p_(psi j) + phi p_(Q j),
///
///     p_(y psi)' = -h (w_psi + f p_(y M))
///     p_(y M)'   = -h (w_M + r p_(y psi) - p_(y Q) - G w_y)
///     p_(y Q)'   = -h w_Q
///     p_(psi M)' = h (p_(psi Q) + G w_psi)
///     p_(psi Q)' = -h (f p_(M Q) - q p_(y psi))
///     p_(M Q)'   = -h (r p_(psi Q) + G w_Q - q p_(y M)),
///
/// q = s^2 + ca s, r = rho I s^2, f = 1/(1 + kv s).
template <class T>
Bivector<T> plane_at_left(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                          const Segment<RealOf<T>>& segment, const Bivector<T>& at_right);

/// The functional g, in 1 - u from the left end: with D w = g_y + G g_M,
///
///     g_y' = -h q g_Q, g_psi' = -h (w + r g_M), g_M' = -h f g_psi, g_Q' = -h (phi w - g_M).
template <class T>
BeamState<T> functional_at_right(const ArmInBeamUnits<RealOf<T>>& arm,
                                 const BeamAtFrequency<T>& beam, const Segment<RealOf<T>>& segment,
                                 const BeamState<T>& at_left);

}  // namespace flexarm::exact_tf
