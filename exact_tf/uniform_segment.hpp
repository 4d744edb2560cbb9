#pragma once

#include "exact_tf/segment_series.hpp"

namespace flexarm::exact_tf {

/// `segment_transfer` without gravity: the exponential of the constant matrix A of d/du,
///
///     y_u = -h (psi + phi Q), psi_u = -h f M, M_u = -h (rho I s^2 psi - Q), Q_u = -h (s^2 + ca s)
///     y,
///
/// f = 1/(1 + kv s). A^2 takes (y, M) and (psi, Q) into themselves, either with trace
/// t = h^2 (phi q + r f) and determinant d = h^4 q f (1 + phi r), q = s^2 + ca s, r = rho I s^2, so
/// that A^4 = t A^2 - d (Cayley and Hamilton) and
///
///     exp A = c0 + c2 A^2 + A (c1 + c3 A^2),   A^(2m) = p_m + r_m A^2,
///     c0, c2 = sum (p_m, r_m)/(2m)!,   c1, c3 = sum (p_m, r_m)/(2m + 1)!.
template <class T>
SegmentTransfer<T> uniform_transfer(const ArmInBeamUnits<RealOf<T>>& arm,
                                    const BeamAtFrequency<T>& beam, RealOf<T> length);

}  // namespace flexarm::exact_tf
