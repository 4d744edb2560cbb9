#include "exact_tf/complex_frequency.hpp"

namespace flexarm::exact_tf {

template <class R>
std::complex<R> ComplexFrequency<R>::at_z(const std::complex<R>& at_lambda) const {
  if (z.imag() == 0) return at_lambda.real();
  return conjugated ? std::conj(at_lambda) : at_lambda;
}

template <class R>
ComplexFrequency<R> complex_frequency(const arm::LinearArm& arm, const std::complex<R>& s_rad_per_s,
                                      const std::complex<R>& damping) {
  const std::complex<R>& s = s_rad_per_s;
  const R l = arm.length_m;
  const R kelvin_voigt_s = arm.kelvin_voigt_s;
  const R rigidity = arm.flexural_rigidity_N_m2;
  const R scale = arm.linear_density_kg_per_m * (l * l * l * l) / rigidity;
  std::complex<R> z = -scale * (s * s);
  if (kelvin_voigt_s > 0) z /= R(1) + kelvin_voigt_s * damping * s;
  const bool conjugated = z.imag() < 0;
  const std::complex<R> canonical(z.real(), std::abs(z.imag()));
  return {std::sqrt(std::sqrt(canonical)), z, conjugated};
}

Real frequency_scale_rad_per_s(const arm::LinearArm& arm) {
  const Real l = arm.length_m;
  const Real rigidity = arm.flexural_rigidity_N_m2;
  return std::sqrt(rigidity / arm.linear_density_kg_per_m) / (l * l);
}

template struct ComplexFrequency<Real>;
template struct ComplexFrequency<double>;
template ComplexFrequency<Real> complex_frequency(const arm::LinearArm&, const Complex&,
                                                  const Complex&);
template ComplexFrequency<double> complex_frequency(const arm::LinearArm&,
                                                    const std::complex<double>&,
                                                    const std::complex<double>&);

}  // namespace flexarm::exact_tf
