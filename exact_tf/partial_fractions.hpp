#pragma once

#include "exact_tf/exact_arm.hpp"

#include <complex>
#include <vector>

namespace flexarm::exact_tf {

/// The transfer function as a sum over the rigid-body mode and the first `order` flexible ones,
/// (48) and (49) of the paper put right: a gain of the accelerometer is phi_i(l), not phi_i''(l),
///
///     theta/tau = 1/(I_T s^2) + 1/I_T sum phi_i'(0)^2/d_i
///     alpha/tau =     l/I_T   + 1/I_T sum phi_i(l) phi_i'(0) s^2/d_i,
///     d_i = s^2 + kv omega_i^2 s + omega_i^2,
///
/// and likewise for the other sensors. Kelvin-Voigt damping leaves the modes uncoupled, so its
/// projection is exact. Hub friction couples them; it is a torque -c s theta, so that with T and
/// theta/tau summed without it the response is T/(1 + c s theta/tau).
///
/// Convergence at fixed s, arm without payload: a term of the hub angle is of order i^-8 with hub
/// inertia (phi_i'(0) ~ i^-2) and i^-2 without, the error of n terms n^-7 and n^-1. Terms at the
/// tip alternate in sign: n^-6 and n^-3.
class PartialFractions {
 public:
  /// For a plain arm. Throws as ExactArm::modes does.
  PartialFractions(const ExactArm& arm, const arm::Sensor& sensor, int order);

  /// Response per unit of torque at s [rad/s]; s = 0 is a std::domain_error.
  std::complex<double> operator()(std::complex<double> s_rad_per_s) const;

 private:
  arm::LinearArm arm_;
  int derivative_order_;
  std::vector<arm::Mode> modes_;  ///< the rigid-body mode first
};

}  // namespace flexarm::exact_tf
