#pragma once

#include "exact_tf/beam_units.hpp"

#include <array>
#include <vector>

namespace flexarm::exact_tf {

/// (y, psi, M, Q) of exact_tf/beam_units.hpp.
template <class T>
using BeamState = std::array<T, 4>;
enum StateIndex : std::size_t { kDisplacement, kRotation, kMoment, kForce };

/// A piece of the beam in units of l.
template <class R>
struct Segment {
  R right = 1;   ///< x of its end towards the tip
  R length = 0;  ///< h

  R left() const { return right - length; }
};

/// K of K^2 = sqrt(|q f|) + |q| phi + |r f| + |g P f|, with q = s^2 + ca s, r = rho I s^2,
/// f = 1/(1 + kv s), in units of the beam: no solution varies faster than exp(K x).
template <class T>
RealOf<T> wave_number(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                      const Segment<RealOf<T>>& segment);

/// The state within a segment, from its value at the right end, as the power series in
/// u = (right - x)/h. With tension g P = G0 + G1 u and 1 + phi g P = D0 + D1 u, both linear, and w
/// the coefficients of y',
///
///     D0 w_n = psi_n + phi Q_n - D1 w_(n-1)
///     (n + 1) y_(n+1)   = -h w_n
///     (n + 1) psi_(n+1) = -h M_n/(1 + kv s)
///     (n + 1) M_(n+1)   = -h (rho I s^2 psi_n - Q_n + G0 w_n + G1 w_(n-1))
///     (n + 1) Q_(n+1)   = -h (s^2 + ca s) y_n.
///
/// The series is summed until four terms in a row no longer change any component, each of which
/// thus keeps its own digits. For segments short enough that terms do not outgrow the sum
/// (exact_tf/transfer_chain.hpp).
template <class T>
class SegmentSeries {
 public:
  SegmentSeries(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                const Segment<RealOf<T>>& segment, const BeamState<T>& at_right);

  /// 0 <= u <= 1.
  BeamState<T> at(RealOf<T> u) const;

 private:
  std::vector<BeamState<T>> coefficients_;
};

/// Column j is the state at the left end that belongs to the unit state j at the right end.
template <class T>
struct SegmentTransfer {
  std::array<BeamState<T>, 4> columns;
  /// The first two columns less those of a rigid rod, (1, 0, 0, 0) and (-h, 1, 0, 0), in full
  /// accuracy where bending is slight.
  std::array<BeamState<T>, 2> bending;
};

/// By the series of each column, or without gravity by that of exact_tf/uniform_segment.hpp.
template <class T>
SegmentTransfer<T> segment_transfer(const ArmInBeamUnits<RealOf<T>>& arm,
                                    const BeamAtFrequency<T>& beam,
                                    const Segment<RealOf<T>>& segment);

/// psi jumps by M/kc: going towards the root it loses crack_flexibility M.
template <class T>
SegmentTransfer<T> crack_transfer(const ArmInBeamUnits<RealOf<T>>& arm);

}  // namespace flexarm::exact_tf
