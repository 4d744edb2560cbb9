#include "response/rigid_hub.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;

arm::SolveSummary closed_form() {
  return {.method = "closed form", .converged = true};
}

arm::Arm valid(arm::Arm arm) {
  arm::require_valid(arm);
  if (arm::has_beam(arm)) throw arm::InputError("rigid_hub: the arm has a [beam]", "beam");
  arm::require_honoured(arm.effects, RigidHub::kName, arm::kLinearArmPorts);
  return arm;
}

/// Both roots of s^2 + b s + k = 0 for b, k >= 0, the smaller by the product of the roots, so that
/// it does not drown in the larger.
arm::PolePair roots(double b, double k) {
  const double half = 0.5 * b;
  const double discriminant = half * half - k;
  if (discriminant < 0.0) {
    const Complex first(-half, std::sqrt(-discriminant));
    return {first, std::conj(first)};
  }
  const double far = -half - std::sqrt(discriminant);
  return {far == 0.0 ? 0.0 : k / far, far};
}

}  // namespace

RigidHub::RigidHub(arm::Arm arm) : arm_(valid(std::move(arm))), linear_(arm::linear_arm(arm_)) {}

double RigidHub::stiffness_per_inertia() const {
  return linear_.hub_spring_N_m_per_rad / linear_.hub_inertia_kg_m2;
}

double RigidHub::friction_per_inertia() const {
  return linear_.hub_viscous_friction_N_m_s_per_rad / linear_.hub_inertia_kg_m2;
}

arm::PoleSet RigidHub::poles(int count) const {
  arm::require_count(count);
  return {.omega_rad_per_s = {},
          .lowest_omega_squared_rad2_per_s2 = stiffness_per_inertia(),
          .count = {0, 0, "degrees of freedom"},
          .summary = closed_form()};
}

arm::ZeroSet RigidHub::zeros(const arm::Sensor& sensor, int count) const {
  arm::require_count(count);
  arm::require_valid(sensor, arm_);
  arm::ZeroSet zeros;
  zeros.count = {0, 0, "degrees of freedom"};
  zeros.summary = closed_form();
  return zeros;
}

arm::DampedPoleSet RigidHub::damped_poles(int count) const {
  arm::require_count(count);
  return {.lowest = roots(friction_per_inertia(), stiffness_per_inertia()),
          .flexible = {},
          .summary = closed_form()};
}

std::vector<arm::Mode> RigidHub::modes(int count, std::span<const arm::Sensor> sensors,
                                       std::span<const double> stations_m) const {
  arm::require_count(count);
  for (const arm::Sensor& sensor : sensors) arm::require_valid(sensor, arm_);
  arm::require_stations(stations_m, arm_);
  return {};
}

arm::ModalModel RigidHub::modal_model(int count, std::span<const arm::Sensor> sensors,
                                      std::span<const double> stations_m) const {
  modes(count, sensors, stations_m);  // throws for what cannot be
  arm::Mode mode;
  mode.omega_rad_per_s = std::sqrt(stiffness_per_inertia());
  mode.hub_slope = 1.0;
  if (mode.omega_rad_per_s > 0.0) {
    mode.damping_ratio = friction_per_inertia() / (2.0 * mode.omega_rad_per_s);
  }
  mode.sensor_values.assign(sensors.size(), 1.0);
  mode.displacement_m.assign(stations_m.size(), 0.0);  // of a hub without radius
  return {.modal_mass_kg_m2 = linear_.hub_inertia_kg_m2,
          .modes = {std::move(mode)},
          .lowest_omega_squared_rad2_per_s2 = stiffness_per_inertia(),
          .damping_rad_per_s = {friction_per_inertia()}};
}

Complex RigidHub::transfer_function(const arm::Sensor& sensor, Complex s_rad_per_s) const {
  arm::require_valid(sensor, arm_);
  const bool is_finite = std::isfinite(s_rad_per_s.real()) && std::isfinite(s_rad_per_s.imag());
  if (!is_finite || (s_rad_per_s == 0.0 && linear_.turns_freely())) {
    throw std::domain_error("transfer function: s = 0 of a free hub, or an s that is not finite");
  }
  const Complex impedance =
      (linear_.hub_inertia_kg_m2 * s_rad_per_s + linear_.hub_viscous_friction_N_m_s_per_rad) *
          s_rad_per_s +
      linear_.hub_spring_N_m_per_rad;
  const Complex angle = 1.0 / impedance;
  return arm::derivative_order(sensor) == 0 ? angle : s_rad_per_s * angle;
}

}  // namespace flexarm::response
