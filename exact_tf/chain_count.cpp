#include "exact_tf/chain_count.hpp"

namespace flexarm::exact_tf {

namespace {

bool opposite(Real a, Real b) {
  return (a < 0.0L) != (b < 0.0L);
}

/// Negative eigenvalues of B, 0 or 2, where they have one sign: that of
/// det(T_uf) p_right (h^2 B_yy + B_psi psi) over p_right.
int definite_pivots(const SegmentTransfer<Real>& transfer, Real length,
                    const Bivector<Real>& right) {
  const auto& c = transfer.columns;
  // States of the plane with (y, psi) = (p, 0) and (0, p).
  const BeamState<Real> displaced = {right.displacement_rotation(), 0.0L, -right.rotation_moment(),
                                     -right.rotation_force()};
  const BeamState<Real> rotated = {0.0L, right.displacement_rotation(), right.displacement_moment(),
                                   right.displacement_force()};
  const auto at_left = [&](const BeamState<Real>& state, std::size_t i) {
    Real sum = 0.0L;
    for (std::size_t j = 0; j < 4; ++j) sum += c[j][i] * state[j];
    return sum;
  };
  const Real displacement_pivot = c[kMoment][kDisplacement] * at_left(displaced, kRotation) -
                                  c[kMoment][kRotation] * at_left(displaced, kDisplacement);
  const Real rotation_pivot = c[kForce][kRotation] * at_left(rotated, kDisplacement) -
                              c[kForce][kDisplacement] * at_left(rotated, kRotation);
  const Real trace = length * length * displacement_pivot + rotation_pivot;
  return opposite(trace, right.displacement_rotation()) ? 2 : 0;
}

}  // namespace

ChainCount count_below(const TransferChain<Real>& chain) {
  ChainCount count;
  ScaledPlane<Real> plane = chain.tip_plane();
  for (const auto& link : chain.links()) {
    const Bivector<Real> right = plane.plane;
    chain.to_left(link, plane);
    if (opposite(plane.plane.displacement_rotation(), right.displacement_rotation())) {
      ++count.hub_held;
    } else if (link.is_segment()) {
      count.hub_held += definite_pivots(chain.transfer(link), link.segment.length, right);
    }
  }
  count.values = root_values(chain, plane.plane, plane.log_scale);
  if (opposite(count.values.hub_angle, plane.plane.displacement_rotation())) ++count.hub_held;
  if (opposite(count.values.motor_angle, count.values.hub_angle)) ++count.hub_held;
  count.poles = count.hub_held + (opposite(count.values.torque, count.values.motor_angle) ? 1 : 0);
  return count;
}

}  // namespace flexarm::exact_tf
