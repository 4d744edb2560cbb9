#pragma once

#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "exact_tf/krylov.hpp"
#include "exact_tf/scaled.hpp"

namespace flexarm::exact_tf {

/// The three numbers that the arm's characteristic functions depend on, formed in long double from
/// the arm's doubles, which count as exact, and rounded to R.
template <class R>
struct InertiaRatiosIn {
  R hub_inertia = 0;      ///< epsilon = Ih/(m l^3)
  R payload_mass = 0;     ///< eta = Mp/(m l)
  R payload_inertia = 0;  ///< mu = Ip/(m l^3)
};
using InertiaRatios = InertiaRatiosIn<Real>;

/// For an arm that `is_plain`.
template <class R = Real>
InertiaRatiosIn<R> inertia_ratios(const arm::LinearArm& arm);

/// The boundary value problem of arm/arm.hpp, which is that of a plain arm, with x in units of l
/// and
///
///     kappa = EI (1 + kv s),   z = lambda^4 = -m s^2 l^4/kappa:
///
///     y'''' = z y;   y(0) = 0;   y''(1) = mu z y'(1);   y'''(1) = -eta z y(1),
///
/// has one solution y(x; z) up to a factor. Scaled so that y(1) = C1 - mu z C2 (Krylov-Duncan
/// functions at lambda) it is an entire function of z, real for real z, and so are the functions
/// below. Torque and hub angle are its boundary values at 0:
///
///     D(s) = m l^3 s^2 E(z) + c s N_hub(z),
///     theta/tau           = N_hub(z)/D
///     y(l)/tau            = l N_tip(z)/D
///     (y(l) - l theta)/tau = l z N_deflection(z)/D
///     y''(X)/tau          = z N_curvature(z; X)/(l D)
///
/// A power of s or z in front is left out of a numerator, so that N(0) > 0, but for the curvature
/// at the tip without payload inertia, which is 0 for every z. Poles of the arm without friction
/// are the roots of E, zeros of a sensor those of its N. On the imaginary axis of s (undamped)
/// lambda is real; on the real axis arg lambda = pi/4; N(conj z) = conj N(z).
///
/// All are evaluated for lambda real (T = Real) or in the closed sector 0 <= arg lambda <= pi/4
/// (T = Complex) without overflow or cancellation, as value * exp(log_scale) with a real
/// log_scale stated below; a = Re lambda, b = Im lambda.

/// N_hub = (1 + K0)/2 - 2 eta z K3 - mu z K1 + 2 eta mu z^2 K4; log_scale = a + b. Its roots are
/// the poles of the arm with its hub held.
template <class T>
T hub_angle_value(const InertiaRatiosIn<RealOf<T>>& ratios, const BeamProducts<T>& k) {
  using R = RealOf<T>;
  const R eta = ratios.payload_mass;
  const R mu = ratios.payload_inertia;
  return R(0.5) * (k.one + k.k0) - k.z * (R(2) * eta * k.k3 + mu * k.k1) +
         R(2) * eta * mu * k.z * k.z * k.k4;
}

/// Y = y''(0)/z = 2 K3 + 2 eta K2 + mu K0 - 2 eta mu z K3; log_scale = a + b. Its roots are the
/// poles of the arm without hub inertia.
template <class T>
T hub_moment_value(const InertiaRatiosIn<RealOf<T>>& ratios, const BeamProducts<T>& k) {
  using R = RealOf<T>;
  const R eta = ratios.payload_mass;
  const R mu = ratios.payload_inertia;
  return R(2) * k.k3 + R(2) * eta * k.k2 + mu * k.k0 - R(2) * eta * mu * k.z * k.k3;
}

/// E = epsilon N_hub + Y, with E(0) = I_T/(m l^3); log_scale = a + b.
template <class T>
T pole_value(const InertiaRatiosIn<RealOf<T>>& ratios, const BeamProducts<T>& k) {
  return ratios.hub_inertia * hub_angle_value(ratios, k) + hub_moment_value(ratios, k);
}

/// N_hub; log_scale = a + b.
template <class T>
Scaled<T> hub_angle_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda);

/// E; log_scale = a + b.
template <class T>
Scaled<T> pole_characteristic(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda);

/// N_tip = C1 - mu z C2, for tip displacement and tip acceleration; log_scale = a.
template <class T>
Scaled<T> tip_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda);

/// N_deflection = (N_tip - N_hub)/z; log_scale = a + b.
template <class T>
Scaled<T> tip_deflection_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda);

/// N_curvature = y''(X)/z, `from_tip` = xi = 1 - X/l in [0, 1]; log_scale = a + b xi.
template <class T>
Scaled<T> curvature_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda,
                              RealOf<T> from_tip);

/// y at x = 1 - xi, `from_tip` = xi; log_scale = a + b xi. Accurate relative to the largest |y|.
template <class T>
Scaled<T> displacement_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda,
                                 RealOf<T> from_tip);

/// xi = 1 - X/l, formed so that no digit is lost near the tip.
Real distance_from_tip(double length_m, double position_m);

/// The numerator of a sensor, by its kind: hub_angle, hub_velocity -> N_hub; tip_acceleration,
/// tip_displacement -> N_tip; tip_deflection -> N_deflection; strain -> N_curvature. `ratios` are
/// those of `arm`.
template <class T>
Scaled<T> sensor_numerator(const arm::LinearArm& arm, const InertiaRatiosIn<RealOf<T>>& ratios,
                           const arm::Sensor& sensor, const T& lambda);

/// What stands in front of that numerator in the list above, time derivatives and half the
/// thickness included: tau to sensor is sensor_factor N/D. `z` belongs to `s` [rad/s].
template <class R>
std::complex<R> sensor_factor(const arm::LinearArm& arm, const arm::Sensor& sensor,
                              const std::complex<R>& s, const std::complex<R>& z);

}  // namespace flexarm::exact_tf
