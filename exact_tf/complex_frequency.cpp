#include "exact_tf/complex_frequency.hpp"

namespace flexarm::exact_tf {

Complex ComplexFrequency::at_z(const Complex& at_lambda) const {
  if (z.imag() == 0.0L) return at_lambda.real();
  return conjugated ? std::conj(at_lambda) : at_lambda;
}

ComplexFrequency complex_frequency(const arm::Arm& arm, std::complex<double> s_rad_per_s) {
  const Complex s(s_rad_per_s.real(), s_rad_per_s.imag());
  const Real l = arm.beam.length_m;
  const Real damping = arm.damping.kelvin_voigt_s;
  const Real rigidity = arm.beam.flexural_rigidity_N_m2();
  const Real scale = arm.beam.linear_density_kg_per_m() * (l * l * l * l) / rigidity;
  Complex z = -scale * (s * s);
  if (damping > 0.0L) z /= 1.0L + damping * s;
  const bool conjugated = z.imag() < 0.0L;
  const Complex canonical(z.real(), std::abs(z.imag()));
  return {std::sqrt(std::sqrt(canonical)), z, conjugated};
}

Real frequency_scale_rad_per_s(const arm::Arm& arm) {
  const Real l = arm.beam.length_m;
  const Real rigidity = arm.beam.flexural_rigidity_N_m2();
  return std::sqrt(rigidity / arm.beam.linear_density_kg_per_m()) / (l * l);
}

}  // namespace flexarm::exact_tf
