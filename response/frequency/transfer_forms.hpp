#pragma once

#include "response/any_formulation.hpp"

#include <complex>
#include <vector>

namespace flexarm::response {

/// Torque to a sensor of the undamped arm over its poles and zeros, (40)-(42) of the paper put
/// right:
///
///     G(s) = gain s^power prod_i (1 - s^2/z_i^2) / prod_i (1 + s^2/omega_i^2)
///
/// where a zero z_i with both parts not 0 stands for the factor of its conjugate as well, and the
/// lowest pole of an arm that something holds is one of the product; that of an arm that turns
/// freely is in s^power. The product over all is exact (Hadamard; the paper's has sums and misses
/// powers of s), and cut off it is right at low frequencies.
struct ProductFactors {
  arm::Sensor sensor;
  double gain = 0.0;  ///< unit of the sensor per N m, times s^-power
  int power = 0;      ///< of s: -2 for the hub angle of an arm that turns freely
  bool turns_freely = true;
  double lowest_omega_squared_rad2_per_s2 = 0.0;  ///< a factor unless the arm turns freely
  std::vector<double> omega_rad_per_s;            ///< flexible poles
  std::vector<std::complex<double>> zeros_rad_per_s;
};

/// `count` poles and zeros. Gain and power are the first Taylor coefficient of the undamped
/// response that is not zero (response/time/taylor_series.hpp). Throws InputError as `poles` and
/// `zeros` do.
ProductFactors product_factors(const AnyFormulation& formulation, const arm::Sensor& sensor,
                               int count);

/// The product at s [rad/s].
std::complex<double> value(const ProductFactors& factors, std::complex<double> s_rad_per_s);

/// One term sigma_i theta_i/I_T s^k/(s^2 + 2 zeta_i omega_i s + omega_i^2) of the modal sum,
/// (48)-(49) of the paper put right, k the derivatives of the sensor. Damping couples modes where D
/// is not diagonal; a term has its diagonal.
struct PartialFraction {
  double omega_squared_rad2_per_s2 = 0.0;
  double damping_rad_per_s = 0.0;  ///< D_ii = 2 zeta_i omega_i
  double residue = 0.0;            ///< sigma_i theta_i/I_T
};

/// A term a mode of `model`, whose values at `sensor` are the `index`-th.
std::vector<PartialFraction> partial_fractions(const arm::ModalModel& model, std::size_t index);

}  // namespace flexarm::response
