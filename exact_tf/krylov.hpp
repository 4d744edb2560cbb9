#pragma once

#include "exact_tf/scaled.hpp"

#include <limits>

namespace flexarm::exact_tf {

/// Krylov-Duncan functions as power series in z = u^4,
///
///     C_k(u)/u^k = sum_n z^n/(4n + k)!,
///
/// for k = 0..3 the functions (cosh + cos)/2, (sinh + sin)/2, (cosh - cos)/2, (sinh - sin)/2 of u
/// over u^k, without the cancellation of these at small u. Meant for |u| of 3 at most.
template <class T>
T krylov_series(int k, const T& z) {
  Real factorial = 1.0L;
  for (int i = 2; i <= k; ++i) factorial *= static_cast<Real>(i);
  T term(1.0L / factorial);
  T sum = term;
  for (int i = k; rough_size(term) > std::numeric_limits<Real>::epsilon() * rough_size(sum);
       i += 4) {
    const auto n = static_cast<Real>(i);
    term *= z / ((n + 1.0L) * (n + 2.0L) * (n + 3.0L) * (n + 4.0L));
    sum += term;
  }
  return sum;
}

/// Below this |lambda| the closed forms cancel and the series are used.
inline constexpr Real kSeriesBound = 2.0L;

/// The products of trigonometric and hyperbolic functions that make up every characteristic
/// function of a uniform beam: entire functions of z = lambda^4, for k = 0..4
///
///     K_k(z) = sum_n (-4z)^n/(4n + k)!,
///
/// K0 = cos cosh, K1 = (cos sinh + sin cosh)/(2 lambda), K2 = sin sinh/(2 lambda^2),
/// K3 = (sin cosh - cos sinh)/(4 lambda^3), K4 = (1 - cos cosh)/(4 lambda^4).
template <class T>
struct BeamProducts {
  T z;       ///< lambda^4, not scaled
  Real one;  ///< 1, times exp(-log_scale) like the rest
  T k0, k1, k2, k3, k4;
  Real log_scale;  ///< Re lambda + Im lambda
};

/// For 0 <= arg lambda <= pi/4.
template <class T>
BeamProducts<T> beam_products(const T& lambda) {
  const Real log_scale = real_part(lambda) + imaginary_part(lambda);
  const Real one = std::exp(-log_scale);
  const T square = lambda * lambda;
  const T z = square * square;
  if (std::abs(lambda) < kSeriesBound) {
    const T argument = -4.0L * z;
    return {z,
            one,
            krylov_series(0, argument) * one,
            krylov_series(1, argument) * one,
            krylov_series(2, argument) * one,
            krylov_series(3, argument) * one,
            krylov_series(4, argument) * one,
            log_scale};
  }
  const auto t = scaled_trigonometry(lambda);
  const T cos_cosh = t.cos * t.cosh;
  const T cos_sinh = t.cos * t.sinh;
  const T sin_cosh = t.sin * t.cosh;
  return {z,
          one,
          cos_cosh,
          (cos_sinh + sin_cosh) / (2.0L * lambda),
          t.sin * t.sinh / (2.0L * square),
          (sin_cosh - cos_sinh) / (4.0L * square * lambda),
          (one - cos_cosh) / (4.0L * z),
          log_scale};
}

}  // namespace flexarm::exact_tf
