#pragma once

#include <cmath>
#include <complex>
#include <limits>

namespace flexarm::exact_tf {

/// Values are formed in the 64-bit significand of x86's long double: at lambda = 1e6 the phase of
/// sin(lambda) keeps 13 digits, where double would keep 10.
using Real = long double;
using Complex = std::complex<Real>;
static_assert(std::numeric_limits<Real>::digits >= 64);

/// A number too large or too small to be held: value * exp(log_scale). The factor is positive and
/// real, so that `value` has the argument and the sign of the number meant.
template <class T>
struct Scaled {
  T value{};
  Real log_scale = 0.0L;
};

/// The real and imaginary part, for formulas that are written once for real and complex lambda.
inline Real real_part(Real x) {
  return x;
}
inline Real real_part(const Complex& x) {
  return x.real();
}
inline Real imaginary_part(Real) {
  return 0.0L;
}
inline Real imaginary_part(const Complex& x) {
  return x.imag();
}

/// The modulus, within a factor sqrt(2) where complex: its root takes as long as a term of a
/// series.
inline Real rough_size(Real x) {
  return std::abs(x);
}
inline Real rough_size(const Complex& x) {
  return std::abs(x.real()) + std::abs(x.imag());
}

/// Trigonometric and hyperbolic functions of u = a + ib, a >= b >= 0, in decaying exponentials.
template <class T>
struct ScaledTrigonometry {
  T sin, cos;    ///< times exp(-b)
  T sinh, cosh;  ///< times exp(-a)
};

inline ScaledTrigonometry<Real> scaled_trigonometry(Real u) {
  const Real decay = std::expm1(-2.0L * u);
  return {std::sin(u), std::cos(u), -0.5L * decay, 1.0L + 0.5L * decay};
}

inline ScaledTrigonometry<Complex> scaled_trigonometry(const Complex& u) {
  const Real sin_a = std::sin(u.real());
  const Real cos_a = std::cos(u.real());
  const Real sin_b = std::sin(u.imag());
  const Real cos_b = std::cos(u.imag());
  const Real sinh_a = -0.5L * std::expm1(-2.0L * u.real());
  const Real cosh_a = 1.0L - sinh_a;
  const Real sinh_b = -0.5L * std::expm1(-2.0L * u.imag());
  const Real cosh_b = 1.0L - sinh_b;
  return {Complex(sin_a * cosh_b, cos_a * sinh_b), Complex(cos_a * cosh_b, -sin_a * sinh_b),
          Complex(cos_b * sinh_a, sin_b * cosh_a), Complex(cos_b * cosh_a, sin_b * sinh_a)};
}

/// exp(ib), the phase of exp(a + ib).
inline Real phase_factor(Real) {
  return 1.0L;
}
inline Complex phase_factor(const Complex& u) {
  return {std::cos(u.imag()), std::sin(u.imag())};
}
inline Real conjugate(Real x) {
  return x;
}
inline Complex conjugate(const Complex& x) {
  return std::conj(x);
}

}  // namespace flexarm::exact_tf
