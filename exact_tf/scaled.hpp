#pragma once

#include <cmath>
#include <complex>
#include <concepts>
#include <limits>

namespace flexarm::exact_tf {

/// Values are formed in the 64-bit significand of x86's long double: at lambda = 1e6 the phase of
/// sin(lambda) keeps 13 digits, where double would keep 10. Functions that fits evaluate thousands
/// of times are templates, for double too.
using Real = long double;
using Complex = std::complex<Real>;
static_assert(std::numeric_limits<Real>::digits >= 64);

/// R of a T that is R or std::complex<R>.
template <class T>
struct RealPartOf {
  using Type = T;
};
template <class R>
struct RealPartOf<std::complex<R>> {
  using Type = R;
};
template <class T>
using RealOf = typename RealPartOf<T>::Type;

/// A number too large or too small to be held: value * exp(log_scale). The factor is positive and
/// real, so that `value` has the argument and the sign of the number meant.
template <class T>
struct Scaled {
  T value{};
  RealOf<T> log_scale = 0;
};

/// The real and imaginary part, for formulas that are written once for real and complex lambda.
template <std::floating_point R>
R real_part(R x) {
  return x;
}
template <class R>
R real_part(const std::complex<R>& x) {
  return x.real();
}
template <std::floating_point R>
R imaginary_part(R) {
  return R(0);
}
template <class R>
R imaginary_part(const std::complex<R>& x) {
  return x.imag();
}

/// Rounded to R, or the same.
template <class R, class Other>
std::complex<R> in(const std::complex<Other>& x) {
  return {static_cast<R>(x.real()), static_cast<R>(x.imag())};
}

/// The modulus, within a factor sqrt(2) where complex: its root takes as long as a term of a
/// series.
template <std::floating_point R>
R rough_size(R x) {
  return std::abs(x);
}
template <class R>
R rough_size(const std::complex<R>& x) {
  return std::abs(x.real()) + std::abs(x.imag());
}

/// Trigonometric and hyperbolic functions of u = a + ib, a >= b >= 0, in decaying exponentials.
template <class T>
struct ScaledTrigonometry {
  T sin, cos;    ///< times exp(-b)
  T sinh, cosh;  ///< times exp(-a)
};

template <std::floating_point R>
ScaledTrigonometry<R> scaled_trigonometry(R u) {
  const R decay = std::expm1(-2 * u);
  return {std::sin(u), std::cos(u), -decay / 2, 1 + decay / 2};
}

template <class R>
ScaledTrigonometry<std::complex<R>> scaled_trigonometry(const std::complex<R>& u) {
  const R sin_a = std::sin(u.real());
  const R cos_a = std::cos(u.real());
  const R sin_b = std::sin(u.imag());
  const R cos_b = std::cos(u.imag());
  const R sinh_a = -std::expm1(-2 * u.real()) / 2;
  const R cosh_a = 1 - sinh_a;
  const R sinh_b = -std::expm1(-2 * u.imag()) / 2;
  const R cosh_b = 1 - sinh_b;
  return {{sin_a * cosh_b, cos_a * sinh_b},
          {cos_a * cosh_b, -sin_a * sinh_b},
          {cos_b * sinh_a, sin_b * cosh_a},
          {cos_b * cosh_a, sin_b * sinh_a}};
}

/// exp(ib), the phase of exp(a + ib).
template <std::floating_point R>
R phase_factor(R) {
  return R(1);
}
template <class R>
std::complex<R> phase_factor(const std::complex<R>& u) {
  return {std::cos(u.imag()), std::sin(u.imag())};
}
template <std::floating_point R>
R conjugate(R x) {
  return x;
}
template <class R>
std::complex<R> conjugate(const std::complex<R>& x) {
  return std::conj(x);
}

}  // namespace flexarm::exact_tf
