#include "exact_tf/product_form.hpp"

#include "exact_tf/complex_frequency.hpp"

#include <stdexcept>

namespace flexarm::exact_tf {

namespace {

/// 1/z at a root s of the undamped arm: z = -(s/omega_scale)^2.
Complex inverse_root(const Complex& s, Real frequency_scale) {
  const Complex relative = frequency_scale / s;
  return -relative * relative;
}

std::vector<Complex> inverse_roots(const arm::ZeroSet& zeros, Real frequency_scale) {
  std::vector<Complex> inverse;
  for (const auto& zero : zeros.s_rad_per_s) {
    const Complex s(zero.real(), zero.imag());
    inverse.push_back(inverse_root(s, frequency_scale));
    // One of a quadruple stands for two roots in z.
    if (zero.real() != 0.0 && zero.imag() != 0.0) inverse.push_back(std::conj(inverse.back()));
  }
  return inverse;
}

/// prod (1 - z/z_i).
Complex product(const std::vector<Complex>& inverse_roots, const Complex& z) {
  Complex value = 1.0L;
  for (const auto& inverse : inverse_roots) value *= 1.0L - z * inverse;
  return value;
}

}  // namespace

ProductForm::ProductForm(const ExactArm& arm, const arm::Sensor& sensor, int order)
    : arm_(arm.linear()), sensor_(sensor) {
  const Real scale = frequency_scale_rad_per_s(arm_);
  zeros_ = inverse_roots(arm.zeros(sensor, order), scale);
  if (arm_.hub_viscous_friction_N_m_s_per_rad > 0.0) {
    hub_ = inverse_roots(arm.zeros({arm::SensorKind::hub_angle}, order), scale);
  }
  for (const double omega : arm.poles(order).omega_rad_per_s) {
    poles_.push_back(inverse_root(Complex(0.0L, omega), scale));
  }
  value_at_rest_ = sensor_numerator(arm_, sensor, Real(0.0L)).value;
}

std::complex<double> ProductForm::operator()(std::complex<double> s_rad_per_s) const {
  if (s_rad_per_s == 0.0) throw std::domain_error("product form: double pole at s = 0");
  const Complex s(s_rad_per_s.real(), s_rad_per_s.imag());
  const Complex z = complex_frequency(arm_, s).z;
  const Real inertia = arm::total_inertia_kg_m2(arm_);
  const Real friction = arm_.hub_viscous_friction_N_m_s_per_rad;
  const Complex denominator =
      inertia * (s * s) * product(poles_, z) + friction * s * product(hub_, z);
  const Complex value =
      sensor_factor(arm_, sensor_, s, z) * value_at_rest_ * product(zeros_, z) / denominator;
  return {static_cast<double>(value.real()), static_cast<double>(value.imag())};
}

}  // namespace flexarm::exact_tf
