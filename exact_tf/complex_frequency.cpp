#include "exact_tf/complex_frequency.hpp"

namespace flexarm::exact_tf {

Complex ComplexFrequency::at_z(const Complex& at_lambda) const {
  if (z.imag() == 0.0L) return at_lambda.real();
  return conjugated ? std::conj(at_lambda) : at_lambda;
}

ComplexFrequency complex_frequency(const arm::LinearArm& arm, const Complex& s_rad_per_s,
                                   const Complex& damping) {
  const Complex& s = s_rad_per_s;
  const Real l = arm.length_m;
  const Real kelvin_voigt_s = arm.kelvin_voigt_s;
  const Real rigidity = arm.flexural_rigidity_N_m2;
  const Real scale = arm.linear_density_kg_per_m * (l * l * l * l) / rigidity;
  Complex z = -scale * (s * s);
  if (kelvin_voigt_s > 0.0L) z /= 1.0L + kelvin_voigt_s * damping * s;
  const bool conjugated = z.imag() < 0.0L;
  const Complex canonical(z.real(), std::abs(z.imag()));
  return {std::sqrt(std::sqrt(canonical)), z, conjugated};
}

Real frequency_scale_rad_per_s(const arm::LinearArm& arm) {
  const Real l = arm.length_m;
  const Real rigidity = arm.flexural_rigidity_N_m2;
  return std::sqrt(rigidity / arm.linear_density_kg_per_m) / (l * l);
}

}  // namespace flexarm::exact_tf
