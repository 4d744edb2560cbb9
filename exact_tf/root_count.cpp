#include "exact_tf/root_count.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::exact_tf {

namespace {

int sign(Real x) {
  return x < 0.0L ? -1 : 1;
}

/// Roots of 1 - cos cosh in (0, lambda): the natural frequencies with all end displacements held.
int count_clamped_below(Real lambda, int sign_of_difference) {
  const auto periods = static_cast<int>(lambda / std::numbers::pi_v<Real>);
  const int parity = periods % 2 == 0 ? 1 : -1;
  return periods - (1 - parity * sign_of_difference) / 2;
}

/// Count of the clamped beam plus the sign changes in the leading minors of the dynamic stiffness,
/// taken in the order tip displacement, tip rotation, hub rotation:
///
///     d0 = 1,  d1 = 2 z (K1 - 2 eta z K4)/Delta,  d2 = 2 z N_hub/Delta,  d3 = -2 z^2 E/Delta,
///
/// Delta = 1 - cos cosh = 4 z K4. Where one of Delta, d1, d2 vanishes the sum is the same on both
/// sides, so a sign that rounding turned there does no harm; the parity of the count is that of
/// the sign of the last function, so that two arguments with counts one apart bracket its root.
int count_below(const InertiaRatios& ratios, Real lambda, bool hub_is_free) {
  if (lambda <= 0.0L) return 0;
  const auto k = beam_products(lambda);
  const int clamped_sign = sign(k.k4);
  const int d1 = clamped_sign * sign(k.k1 - 2.0L * ratios.payload_mass * k.z * k.k4);
  const int d2 = clamped_sign * sign(hub_angle_value(ratios, k));
  int count = count_clamped_below(lambda, clamped_sign);
  count += d1 < 0 ? 1 : 0;
  count += d1 * d2 < 0 ? 1 : 0;
  if (hub_is_free) {
    const int d3 = -clamped_sign * sign(pole_value(ratios, k));
    count += d2 * d3 < 0 ? 1 : 0;
  }
  return count;
}

}  // namespace

int count_poles_below(const InertiaRatios& ratios, Real lambda) {
  constexpr int kRigidBodyModes = 1;
  if (lambda <= 0.0L) return 0;
  return count_below(ratios, lambda, true) - kRigidBodyModes;
}

int count_hub_zeros_below(const InertiaRatios& ratios, Real lambda) {
  return count_below(ratios, lambda, false);
}

}  // namespace flexarm::exact_tf
