#include "exact_tf/partial_fractions.hpp"

#include "exact_tf/scaled.hpp"

#include <array>
#include <ranges>
#include <stdexcept>

namespace flexarm::exact_tf {

PartialFractions::PartialFractions(const ExactArm& arm, const arm::Sensor& sensor, int order)
    : arm_(arm.linear()),
      derivative_order_(derivative_order(sensor)),
      modes_(arm.modal_model(order, std::array{sensor}, {}).modes) {}

std::complex<double> PartialFractions::operator()(std::complex<double> s_rad_per_s) const {
  if (s_rad_per_s == 0.0) throw std::domain_error("partial fractions: double pole at s = 0");
  const Complex s(s_rad_per_s.real(), s_rad_per_s.imag());
  const Real damping = arm_.kelvin_voigt_s;
  const Real friction = arm_.hub_viscous_friction_N_m_s_per_rad;
  const Real inertia = arm::total_inertia_kg_m2(arm_);
  Complex sensor_sum = 0.0L;
  Complex hub_sum = 0.0L;
  // From the smallest term to the largest.
  for (const auto& mode : std::views::reverse(modes_)) {
    const Real stiffness = static_cast<Real>(mode.omega_rad_per_s) * mode.omega_rad_per_s;
    const Real slope = mode.hub_slope;
    const Real sensor_value = mode.sensor_values.front();
    const Complex participation = slope / (s * s + stiffness * (1.0L + damping * s));
    sensor_sum += sensor_value * participation;
    hub_sum += slope * participation;
  }
  Complex value = sensor_sum / (inertia + friction * (s * hub_sum));
  for (int i = 0; i < derivative_order_; ++i) value *= s;
  return {static_cast<double>(value.real()), static_cast<double>(value.imag())};
}

}  // namespace flexarm::exact_tf
