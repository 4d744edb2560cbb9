#include "exact_tf/chain_count.hpp"

#include "exact_tf/boundary_values.hpp"

namespace flexarm::exact_tf {

namespace {

template <class R>
bool opposite(R a, R b) {
  return (a < 0) != (b < 0);
}

/// Negative eigenvalues of B, 0 or 2, where they have one sign: that of
/// det(T_uf) p_right (h^2 B_yy + B_psi psi) over p_right.
template <class R>
int definite_pivots(const SegmentTransfer<R>& transfer, R length, const Bivector<R>& right) {
  const auto& c = transfer.columns;
  // States of the plane with (y, psi) = (p, 0) and (0, p).
  const BeamState<R> displaced = {right.displacement_rotation(), 0, -right.rotation_moment(),
                                  -right.rotation_force()};
  const BeamState<R> rotated = {0, right.displacement_rotation(), right.displacement_moment(),
                                right.displacement_force()};
  const auto at_left = [&](const BeamState<R>& state, std::size_t i) {
    R sum = 0;
    for (std::size_t j = 0; j < 4; ++j) sum += c[j][i] * state[j];
    return sum;
  };
  const R displacement_pivot = c[kMoment][kDisplacement] * at_left(displaced, kRotation) -
                               c[kMoment][kRotation] * at_left(displaced, kDisplacement);
  const R rotation_pivot = c[kForce][kRotation] * at_left(rotated, kDisplacement) -
                           c[kForce][kDisplacement] * at_left(rotated, kRotation);
  const R trace = length * length * displacement_pivot + rotation_pivot;
  return opposite(trace, right.displacement_rotation()) ? 2 : 0;
}

}  // namespace

template <class R>
ChainCount count_below(const TransferChain<R>& chain) {
  ChainCount count;
  ScaledPlane<R> plane = chain.tip_plane();
  for (const auto& link : chain.links()) {
    const Bivector<R> right = plane.plane;
    chain.to_left(link, plane);
    if (opposite(plane.plane.displacement_rotation(), right.displacement_rotation())) {
      ++count.hub_held;
    } else if (link.is_segment()) {
      count.hub_held += definite_pivots(chain.transfer(link), link.segment.length, right);
    }
  }
  const RootValues<R> values = root_values(chain, plane.plane, plane.log_scale);
  if (opposite(values.hub_angle, plane.plane.displacement_rotation())) ++count.hub_held;
  if (opposite(values.motor_angle, values.hub_angle)) ++count.hub_held;
  count.poles = count.hub_held + (opposite(values.torque, values.motor_angle) ? 1 : 0);
  return count;
}

template ChainCount count_below(const TransferChain<Real>&);
template ChainCount count_below(const TransferChain<double>&);

}  // namespace flexarm::exact_tf
