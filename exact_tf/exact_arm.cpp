#include "exact_tf/exact_arm.hpp"

#include "arm/input_error.hpp"
#include "exact_tf/complex_frequency.hpp"
#include "exact_tf/mode_shape.hpp"
#include "exact_tf/sensor_zeros.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::exact_tf {

namespace {

void require_count(int count) {
  arm::require_count(count);
  if (count > kMostRoots) {
    throw arm::out_of_range("count", count, "", fmt::format("from 1 to {}", kMostRoots));
  }
}

std::vector<double> rounded(const std::vector<Real>& values) {
  return {values.begin(), values.end()};
}

/// What a sensor shows of phi, before time derivatives.
Real sensor_value(const arm::Arm& arm, const arm::Sensor& sensor, const ModeShape& shape) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return shape.hub_slope();
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_acceleration:
      return shape.tip_displacement_m();
    case arm::SensorKind::tip_deflection:
      return shape.tip_displacement_m() - arm.beam.length_m * shape.hub_slope();
    case arm::SensorKind::strain:
      return 0.5L * arm.beam.thickness_m.value() * shape.curvature_per_m(sensor.position_m);
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

}  // namespace

ExactArm::ExactArm(arm::Arm arm) : arm_(std::move(arm)) {
  require_computable(arm_);
  require_honoured(arm_.effects, kName, {});
  ratios_ = inertia_ratios(arm_);
}

std::vector<double> ExactArm::pole_lambdas(int count) const {
  require_count(count);
  return rounded(find_poles(ratios_, count).lambda);
}

std::vector<double> ExactArm::hub_zero_lambdas(int count) const {
  require_count(count);
  return rounded(find_hub_zeros(ratios_, count).lambda);
}

arm::PoleSet ExactArm::poles(int count) const {
  require_count(count);
  auto roots = find_poles(ratios_, count);
  const Real scale = frequency_scale_rad_per_s(arm_);
  arm::PoleSet set;
  for (const Real lambda : roots.lambda) {
    set.omega_rad_per_s.push_back(static_cast<double>(lambda * lambda * scale));
  }
  set.count = std::move(roots.count);
  set.summary = std::move(roots.summary);
  return set;
}

arm::ZeroSet ExactArm::zeros(const arm::Sensor& sensor, int count) const {
  require_count(count);
  require_valid(sensor, arm_);
  if (!is_collocated(sensor)) return find_sensor_zeros(arm_, sensor, count);
  auto roots = find_hub_zeros(ratios_, count);
  const Real scale = frequency_scale_rad_per_s(arm_);
  arm::ZeroSet set;
  for (const Real lambda : roots.lambda) {
    set.s_rad_per_s.emplace_back(0.0, static_cast<double>(lambda * lambda * scale));
  }
  set.count = std::move(roots.count);
  set.summary = std::move(roots.summary);
  return set;
}

std::vector<arm::Mode> ExactArm::modes(int count, std::span<const arm::Sensor> sensors,
                                       std::span<const double> stations_m) const {
  require_count(count);
  for (const auto& sensor : sensors) require_valid(sensor, arm_);
  require_stations(stations_m, arm_);
  const auto roots = find_poles(ratios_, count);
  const Real scale = frequency_scale_rad_per_s(arm_);
  std::vector<arm::Mode> modes;
  modes.reserve(roots.lambda.size());
  for (const Real lambda : roots.lambda) {
    const ModeShape shape(arm_, ratios_, lambda);
    const Real omega = lambda * lambda * scale;
    const Real slope = shape.hub_slope();
    const Real damping =
        arm_.damping.kelvin_voigt_s * omega * omega +
        arm_.hub.viscous_friction_N_m_s_per_rad * slope * slope / arm::total_inertia_kg_m2(arm_);
    arm::Mode mode;
    mode.omega_rad_per_s = static_cast<double>(omega);
    mode.hub_slope = static_cast<double>(slope);
    mode.damping_ratio = static_cast<double>(damping / (2.0L * omega));
    for (const auto& sensor : sensors) {
      mode.sensor_values.push_back(static_cast<double>(sensor_value(arm_, sensor, shape)));
    }
    for (const double station_m : stations_m) {
      mode.displacement_m.push_back(static_cast<double>(shape.displacement_m(station_m)));
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

std::complex<double> ExactArm::transfer_function(const arm::Sensor& sensor,
                                                 std::complex<double> s_rad_per_s) const {
  require_valid(sensor, arm_);
  if (s_rad_per_s == 0.0) {
    throw std::domain_error("exact_tf: the transfer function has a double pole at s = 0");
  }
  if (!std::isfinite(s_rad_per_s.real()) || !std::isfinite(s_rad_per_s.imag())) {
    throw std::domain_error("exact_tf: s must be finite");
  }
  const Complex s(s_rad_per_s.real(), s_rad_per_s.imag());
  const auto frequency = complex_frequency(arm_, s_rad_per_s);
  const auto numerator = sensor_numerator(arm_, sensor, frequency.lambda);
  const auto products = beam_products(frequency.lambda);
  const Real l = arm_.beam.length_m;
  const Real beam_inertia = arm_.beam.linear_density_kg_per_m() * (l * l * l);
  const Real friction = arm_.hub.viscous_friction_N_m_s_per_rad;
  const Complex denominator =
      beam_inertia * (s * s) * frequency.at_z(pole_value(ratios_, products)) +
      friction * s * frequency.at_z(hub_angle_value(ratios_, products));
  const Complex value = sensor_factor(arm_, sensor, s, frequency.z) *
                        frequency.at_z(numerator.value) / denominator *
                        std::exp(numerator.log_scale - products.log_scale);
  return {static_cast<double>(value.real()), static_cast<double>(value.imag())};
}

}  // namespace flexarm::exact_tf
