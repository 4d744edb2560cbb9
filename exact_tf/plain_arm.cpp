#include "exact_tf/plain_arm.hpp"

#include "arm/input_error.hpp"
#include "exact_tf/complex_frequency.hpp"
#include "exact_tf/mode_shape.hpp"
#include "exact_tf/pole_continuation.hpp"
#include "exact_tf/root_search.hpp"
#include "exact_tf/sensor_zeros.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::exact_tf {

namespace {

std::vector<double> rounded(const std::vector<Real>& values) {
  return {values.begin(), values.end()};
}

/// What a sensor shows of phi, before time derivatives.
Real sensor_value(const arm::LinearArm& arm, const arm::Sensor& sensor, const ModeShape& shape) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return shape.hub_slope();
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_acceleration:
      return shape.tip_displacement_m();
    case arm::SensorKind::tip_deflection:
      return shape.tip_displacement_m() - arm.length_m * shape.hub_slope();
    case arm::SensorKind::strain:
      return 0.5L * arm.thickness_m.value() * shape.curvature_per_m(sensor.position_m);
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

/// What a sensor shows of phi_0 = x.
double rigid_value(const arm::LinearArm& arm, const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return 1.0;
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_acceleration:
      return arm.length_m;
    case arm::SensorKind::tip_deflection:
    case arm::SensorKind::strain:
      return 0.0;
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

arm::Mode rigid_body_mode(const arm::LinearArm& arm, std::span<const arm::Sensor> sensors,
                          std::span<const double> stations_m) {
  arm::Mode mode;
  mode.hub_slope = 1.0;
  for (const auto& sensor : sensors) mode.sensor_values.push_back(rigid_value(arm, sensor));
  mode.displacement_m.assign(stations_m.begin(), stations_m.end());
  return mode;
}

/// Roots of s^2 + kv omega^2 s + omega^2.
arm::PolePair kelvin_voigt_pair(Real omega, Real kelvin_voigt_s) {
  const Real half = 0.5L * kelvin_voigt_s * omega * omega;
  const Real ratio = half / omega;
  if (ratio < 1.0L) {
    const std::complex<double> first(
        static_cast<double>(-half),
        static_cast<double>(omega * std::sqrt((1.0L - ratio) * (1.0L + ratio))));
    return {first, std::conj(first)};
  }
  const Real far = -half - omega * std::sqrt((ratio - 1.0L) * (ratio + 1.0L));
  return {static_cast<double>(omega * omega / far), static_cast<double>(far)};
}

/// PlainArm::transfer_functions in R.
template <class R>
std::vector<std::complex<double>> closed_responses(const arm::LinearArm& arm,
                                                   const InertiaRatiosIn<R>& ratios,
                                                   std::span<const arm::Sensor> sensors,
                                                   std::complex<double> s_rad_per_s) {
  const std::complex<R> s(s_rad_per_s.real(), s_rad_per_s.imag());
  const auto frequency = complex_frequency(arm, s);
  const auto products = beam_products(frequency.lambda);
  const R l = arm.length_m;
  const R beam_inertia = arm.linear_density_kg_per_m * (l * l * l);
  const R friction = arm.hub_viscous_friction_N_m_s_per_rad;
  const std::complex<R> denominator =
      beam_inertia * (s * s) * frequency.at_z(pole_value(ratios, products)) +
      friction * s * frequency.at_z(hub_angle_value(ratios, products));
  std::vector<std::complex<double>> values;
  for (const arm::Sensor& sensor : sensors) {
    const auto numerator = sensor_numerator(arm, ratios, sensor, frequency.lambda);
    const std::complex<R> value = sensor_factor(arm, sensor, s, frequency.z) *
                                  frequency.at_z(numerator.value) / denominator *
                                  std::exp(numerator.log_scale - products.log_scale);
    values.emplace_back(static_cast<double>(value.real()), static_cast<double>(value.imag()));
  }
  return values;
}

}  // namespace

void require_plain(const arm::Arm& arm, std::string_view who) {
  if (linear_arm(arm).is_plain()) return;
  for (const auto& [name, effect] : arm.effects) {
    arm::Arm without = arm;
    without.effects.erase(name);
    arm::Arm alone = arm;
    alone.effects = {{name, effect}};
    if (!linear_arm(without).is_plain() && linear_arm(alone).is_plain()) continue;
    throw arm::InputError(
        fmt::format("effects.{}: not supported by {} (port {}): it solves a uniform "
                    "Euler-Bernoulli beam clamped to a hub without radius or spring",
                    name, who, arm::to_string(arm::Port::linear_term)),
        "effects." + name);
  }
}

PlainArm::PlainArm(const arm::LinearArm& arm, Arithmetic arithmetic)
    : arm_(arm),
      ratios_(inertia_ratios<Real>(arm)),
      working_ratios_(inertia_ratios<double>(arm)),
      arithmetic_(arithmetic) {}

std::vector<double> PlainArm::pole_lambdas(int count) const {
  return rounded(find_poles(ratios_, count).lambda);
}

std::vector<double> PlainArm::hub_zero_lambdas(int count) const {
  return rounded(find_hub_zeros(ratios_, count).lambda);
}

arm::PoleSet PlainArm::poles(int count) const {
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

arm::DampedPoleSet PlainArm::damped_poles(int count) const {
  const auto roots = find_poles(ratios_, count);
  const Real scale = frequency_scale_rad_per_s(arm_);
  const Real kelvin_voigt_s = arm_.kelvin_voigt_s;
  const Real friction = arm_.hub_viscous_friction_N_m_s_per_rad;
  if (friction == 0.0L) {
    arm::DampedPoleSet set;
    for (const Real lambda : roots.lambda) {
      set.flexible.push_back(kelvin_voigt_pair(lambda * lambda * scale, kelvin_voigt_s));
    }
    set.summary = roots.summary;
    return set;
  }
  const Real inertia = arm::total_inertia_kg_m2(arm_);
  std::vector<UndampedMode> modes = {{0.0L, friction / inertia}};
  for (const Real lambda : roots.lambda) {
    const Real omega = lambda * lambda * scale;
    const Real slope = ModeShape(arm_, ratios_, lambda).hub_slope();
    modes.push_back({omega * omega, friction * slope * slope / inertia});
  }
  const Real l = arm_.length_m;
  const Real beam_inertia = arm_.linear_density_kg_per_m * (l * l * l);
  // D/s = m l^3 s E + c N_hub.
  const auto value_at = [&](const auto& ratios, const auto& s, const auto& damping) {
    using R = decltype(ratios.hub_inertia);
    const auto frequency = complex_frequency(arm_, s, damping);
    const auto products = beam_products(frequency.lambda);
    const auto value =
        static_cast<R>(beam_inertia) * s * frequency.at_z(pole_value(ratios, products)) +
        static_cast<R>(friction) * damping * frequency.at_z(hub_angle_value(ratios, products));
    return Scaled<Complex>{in<Real>(value), products.log_scale};
  };
  const auto characteristic = [&](const Complex& s, const Complex& damping) {
    return arithmetic_ == Arithmetic::working
               ? value_at(working_ratios_, in<double>(s), in<double>(damping))
               : value_at(ratios_, s, damping);
  };
  return follow_damping(characteristic, kelvin_voigt_s, modes);
}

arm::ZeroSet PlainArm::hub_zeros(int count) const {
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

arm::ZeroSet PlainArm::zeros(const arm::Sensor& sensor, int count) const {
  return is_collocated(sensor) ? hub_zeros(count)
                               : find_sensor_zeros(arm_, sensor, count, arithmetic_);
}

DampedZeroSet PlainArm::damped_zeros(
    std::span<const std::complex<double>> undamped_rad_per_s) const {
  const Real kelvin_voigt_s = arm_.kelvin_voigt_s;
  DampedZeroSet set;
  for (const std::complex<double>& undamped : undamped_rad_per_s) {
    if (undamped.real() == 0.0) {
      set.pairs.emplace_back(kelvin_voigt_pair(undamped.imag(), kelvin_voigt_s));
      continue;
    }
    // s = b +- sqrt(b^2 + s_0^2), the one without cancellation first.
    const Complex square = in<Real>(undamped) * in<Real>(undamped);
    const Complex half = 0.5L * kelvin_voigt_s * square;
    const Complex root = std::sqrt(half * half + square);
    const Complex far = std::abs(half + root) >= std::abs(half - root) ? half + root : half - root;
    set.pairs.emplace_back(arm::PolePair{in<double>(-square / far), in<double>(far)});
  }
  set.summary.converged = true;
  set.summary.method = "closed form";
  return set;
}

std::vector<arm::Mode> PlainArm::modes(int count, std::span<const arm::Sensor> sensors,
                                       std::span<const double> stations_m) const {
  const auto roots = find_poles(ratios_, count);
  const Real scale = frequency_scale_rad_per_s(arm_);
  std::vector<arm::Mode> modes;
  modes.reserve(roots.lambda.size());
  for (const Real lambda : roots.lambda) {
    const ModeShape shape(arm_, ratios_, lambda);
    const Real omega = lambda * lambda * scale;
    const Real slope = shape.hub_slope();
    const Real damping =
        arm_.kelvin_voigt_s * omega * omega +
        arm_.hub_viscous_friction_N_m_s_per_rad * slope * slope / arm::total_inertia_kg_m2(arm_);
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

arm::ModalModel PlainArm::modal_model(int count, std::span<const arm::Sensor> sensors,
                                      std::span<const double> stations_m) const {
  arm::ModalModel model;
  model.modal_mass_kg_m2 = arm::total_inertia_kg_m2(arm_);
  model.modes = modes(count, sensors, stations_m);
  model.modes.insert(model.modes.begin(), rigid_body_mode(arm_, sensors, stations_m));
  const std::size_t size = model.modes.size();
  model.damping_rad_per_s.reserve(size * size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      const arm::Mode& a = model.modes[i];
      const arm::Mode& b = model.modes[j];
      const double beam =
          i == j ? arm_.kelvin_voigt_s * a.omega_rad_per_s * a.omega_rad_per_s : 0.0;
      // The slopes first: their product is the same in either order, and so D symmetric.
      const double hub = a.hub_slope * b.hub_slope * arm_.hub_viscous_friction_N_m_s_per_rad;
      model.damping_rad_per_s.push_back(beam + hub / model.modal_mass_kg_m2);
    }
  }
  return model;
}

std::vector<std::complex<double>> PlainArm::transfer_functions(
    std::span<const arm::Sensor> sensors, std::complex<double> s_rad_per_s) const {
  return arithmetic_ == Arithmetic::working
             ? closed_responses(arm_, working_ratios_, sensors, s_rad_per_s)
             : closed_responses(arm_, ratios_, sensors, s_rad_per_s);
}

}  // namespace flexarm::exact_tf
