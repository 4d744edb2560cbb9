#include "exact_tf/numerator.hpp"

#include <stdexcept>

namespace flexarm::exact_tf {

namespace {

/// Weights of the four pairs of functions that a field is made of, see `field`.
template <class T>
struct FieldWeights {
  T cubic;   ///< of cosh - cos, sinh - sin
  T sine;    ///< of 2 sin, 2 sinh
  T cosine;  ///< of 2 cos, 2 cosh
  T linear;  ///< of cosh + cos, sinh + sin
  RealOf<T> oscillating_sign;
};

/// y or y''/z at xi = 1 - x, times exp(-(a + b xi)). With A = lambda, B = lambda xi, and f0..f3 the
/// sums and differences of hyperbolic and trigonometric functions of B, the products of boundary
/// values at A with functions of B are sorted by what multiplies them: exp(A)/2, exp(-A)/2, sin A
/// and cos A. The growing parts of f in the factor of exp(A) cancel by algebra instead of by
/// subtraction.
template <class T>
T field(const FieldWeights<T>& w, const T& lambda, RealOf<T> xi) {
  using R = RealOf<T>;
  const R a = real_part(lambda);
  const R b = imaginary_part(lambda);
  const T at = lambda * xi;
  const auto end = scaled_trigonometry(lambda);
  const auto t = scaled_trigonometry(at);
  const R to_hyperbolic = std::exp(-(a - b) * xi);  // exp(-b xi) to exp(-a xi)
  const R from_exponential = std::exp(-(a + b) * xi);
  const T exp_minus = conjugate(phase_factor(at)) * from_exponential;  // exp(-b xi) e^-B
  const T exp_plus = phase_factor(at);                                 // exp(-a xi) e^B
  const T sum_cosh = t.cosh + t.cos * to_hyperbolic;                   // f0
  const T sum_sinh = t.sinh + t.sin * to_hyperbolic;                   // f1
  T difference_cosh = t.cosh - t.cos * to_hyperbolic;                  // f2
  T difference_sinh = t.sinh - t.sin * to_hyperbolic;                  // f3
  T decaying = exp_minus + t.sin - t.cos;                              // f2 - f3
  T growing = exp_plus - (t.sin + t.cos) * to_hyperbolic;              // f2 + f3
  if (std::abs(at) < R(1)) {
    const T square = at * at;
    const T z = square * square;
    const R scale = std::exp(-a * xi);
    difference_cosh = R(2) * square * krylov_series(2, z) * scale;
    difference_sinh = R(2) * square * at * krylov_series(3, z) * scale;
    decaying = (difference_cosh - difference_sinh) / to_hyperbolic;
    growing = difference_cosh + difference_sinh;
  }
  const T with_exp_plus = w.cubic * decaying + R(2) * (w.sine * t.sin + w.cosine * t.cos) +
                          w.linear * (exp_minus + t.cos - t.sin);
  const T with_exp_minus = -w.cubic * growing +
                           R(2) * (w.cosine * t.cos - w.sine * t.sin) * to_hyperbolic -
                           w.linear * (exp_plus + (t.cos + t.sin) * to_hyperbolic);
  const T with_sin = w.cubic * difference_cosh + R(2) * w.sine * t.sinh - w.linear * sum_cosh;
  const T with_cos = w.linear * sum_sinh + R(2) * w.cosine * t.cosh - w.cubic * difference_sinh;
  return R(0.5) * phase_factor(lambda) * with_exp_plus +
         R(0.5) * std::exp(-R(2) * a + (a - b) * xi) * conjugate(phase_factor(lambda)) *
             with_exp_minus +
         w.oscillating_sign * std::exp(-(a - b) * (R(1) - xi)) *
             (end.sin * with_sin + end.cos * with_cos);
}

/// Krylov-Duncan functions over lambda^k at xi, from their series.
template <class T>
struct KrylovValues {
  T c0, c1, c2, c3;
};

template <class T>
KrylovValues<T> krylov_values(const T& z, RealOf<T> xi) {
  const T argument = z * (xi * xi * xi * xi);
  return {krylov_series(0, argument), krylov_series(1, argument) * xi,
          krylov_series(2, argument) * (xi * xi), krylov_series(3, argument) * (xi * xi * xi)};
}

}  // namespace

template <class R>
InertiaRatiosIn<R> inertia_ratios(const arm::LinearArm& arm) {
  const Real l = arm.length_m;
  const Real mass = arm.linear_density_kg_per_m * l;
  return {static_cast<R>(arm.hub_inertia_kg_m2 / (mass * l * l)),
          static_cast<R>(arm.payload_mass_kg / mass),
          static_cast<R>(arm.payload_tip_inertia_kg_m2 / (mass * l * l))};
}

Real distance_from_tip(double length_m, double position_m) {
  const Real l = length_m;
  return (l - position_m) / l;
}

template <class T>
Scaled<T> hub_angle_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda) {
  const auto k = beam_products(lambda);
  return {hub_angle_value(ratios, k), k.log_scale};
}

template <class T>
Scaled<T> pole_characteristic(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda) {
  const auto k = beam_products(lambda);
  return {pole_value(ratios, k), k.log_scale};
}

template <class T>
Scaled<T> tip_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda) {
  using R = RealOf<T>;
  const R mu = ratios.payload_inertia;
  const R a = real_part(lambda);
  const T square = lambda * lambda;
  if (std::abs(lambda) < kSeriesBound) {
    const T z = square * square;
    return {(krylov_series(1, z) - mu * z * krylov_series(2, z)) * std::exp(-a), a};
  }
  const auto t = scaled_trigonometry(lambda);
  const R to_hyperbolic = std::exp(imaginary_part(lambda) - a);
  return {(t.sinh + t.sin * to_hyperbolic) / (R(2) * lambda) -
              R(0.5) * mu * square * (t.cosh - t.cos * to_hyperbolic),
          a};
}

template <class T>
Scaled<T> tip_deflection_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda) {
  using R = RealOf<T>;
  const auto k = beam_products(lambda);
  if (std::abs(lambda) < kSeriesBound) {
    const R eta = ratios.payload_mass;
    const R mu = ratios.payload_inertia;
    const T c5 = krylov_series(5, k.z) * k.one;
    const T c2 = krylov_series(2, k.z) * k.one;
    return {c5 + R(2) * k.k4 + R(2) * eta * k.k3 + mu * (k.k1 - c2) - R(2) * eta * mu * k.z * k.k4,
            k.log_scale};
  }
  const T tip = tip_numerator(ratios, lambda).value * std::exp(-imaginary_part(lambda));
  return {(tip - hub_angle_value(ratios, k)) / k.z, k.log_scale};
}

template <class T>
Scaled<T> curvature_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda,
                              RealOf<T> from_tip) {
  using R = RealOf<T>;
  const R eta = ratios.payload_mass;
  const R mu = ratios.payload_inertia;
  const R log_scale = real_part(lambda) + imaginary_part(lambda) * from_tip;
  const T square = lambda * lambda;
  if (std::abs(lambda) < kSeriesBound) {
    const T z = square * square;
    const auto at_hub = krylov_values(z, R(1));
    const auto here = krylov_values(z, from_tip);
    const T value = at_hub.c1 * here.c2 - at_hub.c0 * here.c3 +
                    eta * (at_hub.c1 * here.c1 - z * at_hub.c3 * here.c3) +
                    mu * (at_hub.c0 * here.c0 - z * at_hub.c2 * here.c2) +
                    eta * mu * z * (at_hub.c3 * here.c0 - at_hub.c2 * here.c1);
    return {value * std::exp(-log_scale), log_scale};
  }
  const FieldWeights<T> weights{R(0.25) / (square * lambda), R(0.25) * eta / square,
                                T(R(0.25) * mu), R(0.25) * eta * mu * lambda, R(1)};
  return {field(weights, lambda, from_tip), log_scale};
}

template <class T>
Scaled<T> displacement_numerator(const InertiaRatiosIn<RealOf<T>>& ratios, const T& lambda,
                                 RealOf<T> from_tip) {
  using R = RealOf<T>;
  const R eta = ratios.payload_mass;
  const R mu = ratios.payload_inertia;
  const R log_scale = real_part(lambda) + imaginary_part(lambda) * from_tip;
  const T square = lambda * lambda;
  if (std::abs(lambda) < kSeriesBound) {
    const T z = square * square;
    const auto at_hub = krylov_values(z, R(1));
    const auto here = krylov_values(z, from_tip);
    const T value = at_hub.c1 * here.c0 - at_hub.c0 * here.c1 +
                    eta * z * (at_hub.c1 * here.c3 - at_hub.c3 * here.c1) -
                    mu * z * (at_hub.c2 * here.c0 - at_hub.c0 * here.c2) +
                    eta * mu * z * z * (at_hub.c3 * here.c2 - at_hub.c2 * here.c3);
    return {value * std::exp(-log_scale), log_scale};
  }
  const FieldWeights<T> weights{R(0.25) * eta * mu * square * lambda, T(-R(0.25) * eta),
                                -R(0.25) * mu * square, R(0.25) / lambda, -R(1)};
  return {field(weights, lambda, from_tip), log_scale};
}

template <class T>
Scaled<T> sensor_numerator(const arm::LinearArm& arm, const InertiaRatiosIn<RealOf<T>>& ratios,
                           const arm::Sensor& sensor, const T& lambda) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return hub_angle_numerator(ratios, lambda);
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
      return tip_numerator(ratios, lambda);
    case arm::SensorKind::tip_deflection:
      return tip_deflection_numerator(ratios, lambda);
    case arm::SensorKind::strain:
      return curvature_numerator(
          ratios, lambda,
          static_cast<RealOf<T>>(distance_from_tip(arm.length_m, sensor.position_m)));
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

template <class R>
std::complex<R> sensor_factor(const arm::LinearArm& arm, const arm::Sensor& sensor,
                              const std::complex<R>& s, const std::complex<R>& z) {
  const R l = arm.length_m;
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
      return R(1);
    case arm::SensorKind::hub_velocity:
      return s;
    case arm::SensorKind::tip_displacement:
      return l;
    case arm::SensorKind::tip_acceleration:
      return l * (s * s);
    case arm::SensorKind::tip_deflection:
      return l * z;
    case arm::SensorKind::strain:
      return R(0.5) * R(arm.thickness_m.value()) / l * z;
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

template Scaled<Real> hub_angle_numerator(const InertiaRatiosIn<Real>&, const Real&);
template Scaled<Complex> hub_angle_numerator(const InertiaRatiosIn<Real>&, const Complex&);
template Scaled<double> hub_angle_numerator(const InertiaRatiosIn<double>&, const double&);
template Scaled<std::complex<double>> hub_angle_numerator(const InertiaRatiosIn<double>&,
                                                          const std::complex<double>&);
template Scaled<Real> pole_characteristic(const InertiaRatiosIn<Real>&, const Real&);
template Scaled<Complex> pole_characteristic(const InertiaRatiosIn<Real>&, const Complex&);
template Scaled<double> pole_characteristic(const InertiaRatiosIn<double>&, const double&);
template Scaled<std::complex<double>> pole_characteristic(const InertiaRatiosIn<double>&,
                                                          const std::complex<double>&);
template Scaled<Real> tip_numerator(const InertiaRatiosIn<Real>&, const Real&);
template Scaled<Complex> tip_numerator(const InertiaRatiosIn<Real>&, const Complex&);
template Scaled<double> tip_numerator(const InertiaRatiosIn<double>&, const double&);
template Scaled<std::complex<double>> tip_numerator(const InertiaRatiosIn<double>&,
                                                    const std::complex<double>&);
template Scaled<Real> tip_deflection_numerator(const InertiaRatiosIn<Real>&, const Real&);
template Scaled<Complex> tip_deflection_numerator(const InertiaRatiosIn<Real>&, const Complex&);
template Scaled<double> tip_deflection_numerator(const InertiaRatiosIn<double>&, const double&);
template Scaled<std::complex<double>> tip_deflection_numerator(const InertiaRatiosIn<double>&,
                                                               const std::complex<double>&);
template Scaled<Real> curvature_numerator(const InertiaRatiosIn<Real>&, const Real&, Real);
template Scaled<Complex> curvature_numerator(const InertiaRatiosIn<Real>&, const Complex&, Real);
template Scaled<double> curvature_numerator(const InertiaRatiosIn<double>&, const double&, double);
template Scaled<std::complex<double>> curvature_numerator(const InertiaRatiosIn<double>&,
                                                          const std::complex<double>&, double);
template Scaled<Real> displacement_numerator(const InertiaRatiosIn<Real>&, const Real&, Real);
template Scaled<Complex> displacement_numerator(const InertiaRatiosIn<Real>&, const Complex&, Real);
template Scaled<double> displacement_numerator(const InertiaRatiosIn<double>&, const double&,
                                               double);
template Scaled<std::complex<double>> displacement_numerator(const InertiaRatiosIn<double>&,
                                                             const std::complex<double>&, double);
template Scaled<Real> sensor_numerator(const arm::LinearArm&, const InertiaRatiosIn<Real>&,
                                       const arm::Sensor&, const Real&);
template Scaled<Complex> sensor_numerator(const arm::LinearArm&, const InertiaRatiosIn<Real>&,
                                          const arm::Sensor&, const Complex&);
template Scaled<double> sensor_numerator(const arm::LinearArm&, const InertiaRatiosIn<double>&,
                                         const arm::Sensor&, const double&);
template Scaled<std::complex<double>> sensor_numerator(const arm::LinearArm&,
                                                       const InertiaRatiosIn<double>&,
                                                       const arm::Sensor&,
                                                       const std::complex<double>&);
template InertiaRatios inertia_ratios(const arm::LinearArm&);
template InertiaRatiosIn<double> inertia_ratios(const arm::LinearArm&);
template Complex sensor_factor(const arm::LinearArm&, const arm::Sensor&, const Complex&,
                               const Complex&);
template std::complex<double> sensor_factor(const arm::LinearArm&, const arm::Sensor&,
                                            const std::complex<double>&,
                                            const std::complex<double>&);

}  // namespace flexarm::exact_tf
