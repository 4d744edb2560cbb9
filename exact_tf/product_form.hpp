#pragma once

#include "exact_tf/exact_arm.hpp"

#include <complex>
#include <vector>

namespace flexarm::exact_tf {

/// The transfer function as a product over its first `order` poles and zeros, (40)-(42) of the
/// paper put right: products, not sums, and every power of s that belongs in front,
///
///     theta/tau = 1/(I_T s^2) prod (1 + w^2/Omega_i^2)/(1 + w^2/omega_i^2)
///     alpha/tau =    l/I_T    prod (1 - w^2/s_i^2)/(1 + w^2/omega_i^2),
///
/// w^2 = s^2/(1 + kv s), with Omega_i the hub-angle zeros and s_i those of the sensor; likewise for
/// the other sensors. E and the numerators are entire functions of z = lambda^4 of order 1/4, so
/// that each is its value at 0 times prod (1 - z/z_i) (Hadamard); Kelvin-Voigt damping is exact as
/// it enters through z, hub friction as it enters the denominator by m l^3 s^2 E + c s N_hub.
///
/// Convergence at fixed s: the relative error of n factors is the tail of sum (1/z_i,pole -
/// 1/z_i,zero), |z_i| ~ i^4. It falls as n^-3 for sensors away from the hub. For the hub angle
/// poles and zeros pair off: n^-4 without hub inertia; n^-7 with it, once lambda^3 > 1/epsilon, for
/// then a pole and its zero are some 1/(epsilon lambda^3) apart.
class ProductForm {
 public:
  /// For a plain arm. Throws as ExactArm::poles and ExactArm::zeros do.
  ProductForm(const ExactArm& arm, const arm::Sensor& sensor, int order);

  /// Response per unit of torque at s [rad/s]; s = 0 is a std::domain_error.
  std::complex<double> operator()(std::complex<double> s_rad_per_s) const;

 private:
  arm::LinearArm arm_;
  arm::Sensor sensor_;
  Real value_at_rest_;          ///< N(0) of the sensor
  std::vector<Complex> zeros_;  ///< 1/z_i of the sensor's numerator
  std::vector<Complex> hub_;    ///< 1/z_i of N_hub; empty where there is no friction
  std::vector<Complex> poles_;  ///< 1/z_i of E
};

}  // namespace flexarm::exact_tf
