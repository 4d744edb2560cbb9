#pragma once

#include "arm/linear_arm.hpp"
#include "exact_tf/scaled.hpp"

namespace flexarm::exact_tf {

/// lambda at a complex frequency, brought into the sector 0 <= arg lambda <= pi/4 that the
/// numerators are evaluated in.
template <class R>
struct ComplexFrequency {
  std::complex<R> lambda;
  std::complex<R> z;  ///< -m s^2 l^4/kappa with kappa = EI (1 + kv s), as it is
  bool conjugated;    ///< lambda^4 is conj(z): values at z are the conjugates of those at lambda
  /// The value at z of a function that is real for real z, from its value at lambda.
  std::complex<R> at_z(const std::complex<R>& at_lambda) const;
};

/// With the damping times `damping`. Not finite at s = -1/kv, where the poles of a Kelvin-Voigt
/// beam accumulate.
template <class R>
ComplexFrequency<R> complex_frequency(const arm::LinearArm& arm, const std::complex<R>& s_rad_per_s,
                                      const std::complex<R>& damping = R(1));

/// sqrt(EI/(m l^4)) in long double: omega = lambda^2 times this [rad/s].
Real frequency_scale_rad_per_s(const arm::LinearArm& arm);

}  // namespace flexarm::exact_tf
