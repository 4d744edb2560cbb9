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
  using R = RealOf<T>;
  R factorial = 1;
  for (int i = 2; i <= k; ++i) factorial *= static_cast<R>(i);
  T term(1 / factorial);
  T sum = term;
  for (int i = k; rough_size(term) > std::numeric_limits<R>::epsilon() * rough_size(sum); i += 4) {
    const auto n = static_cast<R>(i);
    term *= z / ((n + 1) * (n + 2) * (n + 3) * (n + 4));
    sum += term;
  }
  return sum;
}

/// Below this |lambda| the closed forms cancel and the series are used.
inline constexpr double kSeriesBound = 2.0;

/// The products of trigonometric and hyperbolic functions that make up every characteristic
/// function of a uniform beam: entire functions of z = lambda^4, for k = 0..4
///
///     K_k(z) = sum_n (-4z)^n/(4n + k)!,
///
/// K0 = cos cosh, K1 = (cos sinh + sin cosh)/(2 lambda), K2 = sin sinh/(2 lambda^2),
/// K3 = (sin cosh - cos sinh)/(4 lambda^3), K4 = (1 - cos cosh)/(4 lambda^4).
template <class T>
struct BeamProducts {
  T z;            ///< lambda^4, not scaled
  RealOf<T> one;  ///< 1, times exp(-log_scale) like the rest
  T k0, k1, k2, k3, k4;
  RealOf<T> log_scale;  ///< Re lambda + Im lambda
};

/// For 0 <= arg lambda <= pi/4.
template <class T>
BeamProducts<T> beam_products(const T& lambda) {
  using R = RealOf<T>;
  const R log_scale = real_part(lambda) + imaginary_part(lambda);
  const R one = std::exp(-log_scale);
  const T square = lambda * lambda;
  const T z = square * square;
  if (std::abs(lambda) < kSeriesBound) {
    const T argument = -R(4) * z;
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
          (cos_sinh + sin_cosh) / (R(2) * lambda),
          t.sin * t.sinh / (R(2) * square),
          (sin_cosh - cos_sinh) / (R(4) * square * lambda),
          (one - cos_cosh) / (R(4) * z),
          log_scale};
}

}  // namespace flexarm::exact_tf
