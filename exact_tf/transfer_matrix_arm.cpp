#include "exact_tf/transfer_matrix_arm.hpp"

#include "arm/input_error.hpp"
#include "exact_tf/boundary_values.hpp"
#include "exact_tf/chain_eigenvalues.hpp"
#include "exact_tf/chain_modes.hpp"
#include "exact_tf/pole_continuation.hpp"
#include "exact_tf/sensor_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

namespace flexarm::exact_tf {

namespace {

void require_chain_count(int count) {
  if (count > TransferMatrixArm::kMostRoots) {
    throw arm::out_of_range(
        "count", count, "",
        fmt::format("from 1 to {} with these effects", TransferMatrixArm::kMostRoots));
  }
}

/// A standing beam buckles at some acceleration below 0; found to four digits.
double buckling_acceleration(ArmInBeamUnits<Real> units, double acceleration_m_per_s2) {
  const Real given = units.gravity;
  Real stable = 0.0L;
  Real unstable = 1.0L;
  while (unstable - stable > 1e-4L * unstable) {
    const Real middle = 0.5L * (stable + unstable);
    units.gravity = given * middle;
    (flexible_modes_are_stable(units) ? stable : unstable) = middle;
  }
  return acceleration_m_per_s2 * static_cast<double>(stable);
}

double rounded(Real value) {
  return static_cast<double>(value);
}

/// No power of s is left in front of a sensor's numerator: what shows no rigid motion starts with
/// s^2, unless gravity bends the beam at rest.
template <class R>
bool vanishes_at_rest(const ArmInBeamUnits<R>& arm, arm::SensorKind kind) {
  return arm.gravity == 0 &&
         (kind == arm::SensorKind::tip_deflection || kind == arm::SensorKind::strain);
}

/// What turns a value in units of the beam into the sensor's reading before time derivatives.
Real sensor_unit(const arm::LinearArm& arm, arm::SensorKind kind) {
  switch (kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return 1.0L;
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_deflection:
      return arm.length_m;
    case arm::SensorKind::strain:
      return 0.5L * arm.thickness_m.value() / arm.length_m;
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

template <class R>
R modal_value(const ChainModes<R>& modes, std::size_t i, arm::SensorKind kind, R position,
              R reach) {
  switch (kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return modes.motor_angle(i);
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_acceleration:
      return modes.tip_displacement(i);
    case arm::SensorKind::tip_deflection:
      return modes.tip_displacement(i) - reach * modes.hub_angle(i);
    case arm::SensorKind::strain:
      return modes.curvature(i, position);
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

template <class R>
std::vector<R> all_in(const std::vector<Real>& values) {
  std::vector<R> made;
  for (const Real value : values) made.push_back(static_cast<R>(value));
  return made;
}

// What TransferMatrixArm answers, in R.

template <class R>
arm::PoleSet chain_poles(const ArmInBeamUnits<R>& units, int count) {
  auto roots = find_chain_poles(units, count);
  const Real scale = units.omega_scale_rad_per_s;
  arm::PoleSet set;
  set.lowest_omega_squared_rad2_per_s2 = rounded(roots.omega_squared.front() * scale * scale);
  for (std::size_t i = 1; i < roots.omega_squared.size(); ++i) {
    set.omega_rad_per_s.push_back(rounded(std::sqrt(roots.omega_squared[i]) * scale));
  }
  set.count = std::move(roots.count);
  set.summary = std::move(roots.summary);
  return set;
}

template <class R>
arm::DampedPoleSet chain_damped_poles(const ArmInBeamUnits<R>& units, double kelvin_voigt_s,
                                      int count) {
  using T = std::complex<R>;
  const auto roots = find_chain_poles(units, count);
  const ChainModes<R> shapes(units, all_in<R>(roots.omega_squared));
  const Real scale = units.omega_scale_rad_per_s;
  std::vector<UndampedMode> modes;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Real omega_squared = roots.omega_squared[i];
    modes.push_back({omega_squared * scale * scale,
                     (shapes.damping(i, i) - units.kelvin_voigt * omega_squared) * scale});
  }
  const auto characteristic = [&](const Complex& s, const Complex& damping) -> Scaled<Complex> {
    const T in_units = in<R>(s / scale);
    try {
      const TransferChain<T> chain(units, damped_at(units, in_units, in<R>(damping)));
      const auto values = root_values(chain);
      const T value = units.turns_freely() ? values.torque / in_units : values.torque;
      return {in<Real>(value), values.log_scale};
    } catch (const std::domain_error&) {
      return {std::numeric_limits<Real>::quiet_NaN(), 0.0L};
    }
  };
  return follow_damping(characteristic, kelvin_voigt_s, modes);
}

template <class R>
arm::ZeroSet chain_hub_zeros(const ArmInBeamUnits<R>& units, int count) {
  // One eigenvalue at most is negative, and another may be nearer to 0.
  const int looked_for = units.gravity < 0 ? count + 1 : count;
  auto roots = find_chain_hub_zeros(units, looked_for);
  std::ranges::sort(roots.omega_squared, {}, [](Real square) { return std::abs(square); });
  roots.omega_squared.resize(static_cast<std::size_t>(count));
  const Real scale = units.omega_scale_rad_per_s;
  arm::ZeroSet set;
  for (const Real square : roots.omega_squared) {
    const double size = rounded(std::sqrt(std::abs(square)) * scale);
    set.s_rad_per_s.push_back(square < 0.0L ? std::complex(size, 0.0) : std::complex(0.0, size));
  }
  set.count = std::move(roots.count);
  set.count.found -= looked_for - count;
  set.count.expected -= looked_for - count;
  set.summary = std::move(roots.summary);
  return set;
}

template <class R>
arm::ZeroSet chain_zeros(const ArmInBeamUnits<R>& units, const arm::Sensor& sensor, int count) {
  constexpr auto arithmetic =
      std::is_same_v<R, double> ? Arithmetic::working : Arithmetic::extended;
  if (is_collocated(sensor)) return chain_hub_zeros(units, count);
  const R position = sensor.position_m / units.length_m;
  const bool divided = vanishes_at_rest(units, sensor.kind);
  const bool with_planes = derivative_order(sensor) == 0;
  const auto value_at = [&](const auto& z) {
    using T = std::remove_cvref_t<decltype(z)>;
    const TransferChain<T> chain(units, undamped_at(units, z), with_planes);
    const auto value = sensor_value(chain, sensor.kind, position);
    return value.value / (divided ? z * value.size : T(value.size));
  };
  const auto numerator = [&](const Complex& lambda) -> Complex {
    const Complex square = lambda * lambda;
    const std::complex<R> z = in<R>(square * square);
    return z.imag() == 0 ? Complex(value_at(z.real())) : in<Real>(value_at(z));
  };
  return find_sensor_zeros(numerator, units.omega_scale_rad_per_s, count, zero_options(arithmetic));
}

/// D of UndampedMode of the root s of F(s; 0): F depends on s^2 and s d, so that ds/dd is real.
Real decay_of(const DampedCharacteristic& characteristic, const Complex& s, Real kelvin_voigt_s) {
  constexpr Real kChange = 1e-5L;  // central differences: errors of 1e-10, of a path's first step
  const auto change = [&](const Complex& s_step, const Complex& damping_step) {
    const auto after = characteristic(s + s_step, damping_step);
    const auto before = characteristic(s - s_step, -damping_step);
    return std::pair(after.value - before.value * std::exp(before.log_scale - after.log_scale),
                     after.log_scale);
  };
  const auto [by_s, scale_by_s] = change(kChange * s, 0.0L);
  const auto [by_damping, scale_by_damping] = change(0.0L, kChange);
  const Complex speed = -s * by_damping / by_s * std::exp(scale_by_damping - scale_by_s);
  return -2.0L * speed.real() + kelvin_voigt_s * (s * s).real();
}

template <class R>
DampedZeroSet chain_damped_zeros(const ArmInBeamUnits<R>& units, double kelvin_voigt_s,
                                 const arm::Sensor& sensor,
                                 std::span<const std::complex<double>> undamped_rad_per_s) {
  const Real scale = units.omega_scale_rad_per_s;
  const R position = sensor.position_m / units.length_m;
  const DampedCharacteristic characteristic = [&](const Complex& s,
                                                  const Complex& damping) -> Scaled<Complex> {
    try {
      const TransferChain<std::complex<R>> chain(
          units, damped_at(units, in<R>(s / scale), in<R>(damping)));
      const auto value = sensor_value(chain, sensor.kind, position);
      return {in<Real>(value.value), value.log_scale};
    } catch (const std::domain_error&) {
      return {std::numeric_limits<Real>::quiet_NaN(), 0.0L};
    }
  };
  DampedZeroSet set;
  std::vector<UndampedMode> followed;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < undamped_rad_per_s.size(); ++i) {
    const Complex s = in<Real>(undamped_rad_per_s[i]);
    if (s.real() != 0.0L && s.imag() != 0.0L) continue;
    followed.push_back({-(s * s).real(), decay_of(characteristic, s, kelvin_voigt_s)});
    places.push_back(i);
  }
  set.pairs.resize(undamped_rad_per_s.size());
  if (followed.empty()) {
    set.summary.converged = undamped_rad_per_s.empty();
    return set;
  }
  const arm::DampedPoleSet roots = follow_damping(characteristic, kelvin_voigt_s, followed);
  set.summary = roots.summary;
  if (!set.summary.converged) return set;
  set.pairs[places.front()] = roots.lowest;
  for (std::size_t i = 1; i < places.size(); ++i) set.pairs[places[i]] = roots.flexible[i - 1];
  set.summary.converged = places.size() == undamped_rad_per_s.size();
  return set;
}

template <class R>
arm::ModalModel chain_model(const arm::LinearArm& arm, const ArmInBeamUnits<R>& units, int count,
                            std::span<const arm::Sensor> sensors,
                            std::span<const double> stations_m) {
  const auto roots = find_chain_poles(units, count);
  const ChainModes<R> shapes(units, all_in<R>(roots.omega_squared));
  const Real scale = units.omega_scale_rad_per_s;
  const R reach = 1 + units.hub_radius;
  const auto in_units = [&](double position_m) -> R { return position_m / units.length_m; };
  arm::ModalModel model;
  model.modal_mass_kg_m2 = arm::total_inertia_kg_m2(arm);
  model.lowest_omega_squared_rad2_per_s2 = rounded(roots.omega_squared.front() * scale * scale);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    arm::Mode mode;
    mode.omega_rad_per_s = rounded(std::sqrt(std::max(0.0L, roots.omega_squared[i])) * scale);
    mode.hub_slope = rounded(shapes.motor_angle(i));
    if (mode.omega_rad_per_s > 0.0) {
      mode.damping_ratio =
          rounded(shapes.damping(i, i) / (2.0L * std::sqrt(roots.omega_squared[i])));
    }
    for (const auto& sensor : sensors) {
      mode.sensor_values.push_back(
          rounded(sensor_unit(arm, sensor.kind) *
                  modal_value(shapes, i, sensor.kind, in_units(sensor.position_m), reach)));
    }
    for (const double station_m : stations_m) {
      mode.displacement_m.push_back(
          rounded(units.length_m * shapes.displacement(i, in_units(station_m))));
    }
    model.modes.push_back(std::move(mode));
  }
  model.damping_rad_per_s.resize(shapes.size() * shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      model.damping_rad_per_s[i * shapes.size() + j] =
          model.damping_rad_per_s[j * shapes.size() + i] = rounded(shapes.damping(i, j) * scale);
    }
  }
  return model;
}

template <class R>
std::vector<std::complex<double>> chain_responses(const arm::LinearArm& arm,
                                                  const ArmInBeamUnits<R>& units,
                                                  std::span<const arm::Sensor> sensors,
                                                  std::complex<double> s_rad_per_s) {
  using T = std::complex<R>;
  const T s(s_rad_per_s.real(), s_rad_per_s.imag());
  const TransferChain<T> chain(units, damped_at(units, s / units.omega_scale_rad_per_s));
  const auto root = root_values(chain);
  std::vector<std::complex<double>> values;
  for (const arm::Sensor& sensor : sensors) {
    const auto output =
        sensor_value<T>(chain, sensor.kind, R(sensor.position_m / units.length_m), root);
    const auto unit = static_cast<R>(sensor_unit(arm, sensor.kind)) / units.torque_scale_N_m;
    T value = unit * std::exp(output.log_scale - root.log_scale) * output.value / root.torque;
    for (int i = 0; i < derivative_order(sensor); ++i) value *= s;
    values.emplace_back(rounded(value.real()), rounded(value.imag()));
  }
  return values;
}

}  // namespace

TransferMatrixArm::TransferMatrixArm(const arm::LinearArm& arm, Arithmetic arithmetic)
    : arm_(arm), units_(in_beam_units<Real>(arm)) {
  const auto& exact = std::get<ArmInBeamUnits<Real>>(units_);
  if (!flexible_modes_are_stable(exact)) {
    throw arm::out_of_range(
        "effects.gravity.acceleration", arm.gravity_m_per_s2, "m/s^2",
        fmt::format("above {:.4g} m/s^2, the buckling limit of the inverted arm",
                    buckling_acceleration(exact, arm.gravity_m_per_s2)));
  }
  if (arithmetic == Arithmetic::working) units_ = in_beam_units<double>(arm);
}

arm::PoleSet TransferMatrixArm::poles(int count) const {
  require_chain_count(count);
  return std::visit([&](const auto& units) { return chain_poles(units, count); }, units_);
}

arm::DampedPoleSet TransferMatrixArm::damped_poles(int count) const {
  require_chain_count(count);
  const auto poles = [&](const auto& units) {
    return chain_damped_poles(units, arm_.kelvin_voigt_s, count);
  };
  return std::visit(poles, units_);
}

arm::ZeroSet TransferMatrixArm::zeros(const arm::Sensor& sensor, int count) const {
  require_chain_count(count);
  return std::visit([&](const auto& units) { return chain_zeros(units, sensor, count); }, units_);
}

DampedZeroSet TransferMatrixArm::damped_zeros(
    const arm::Sensor& sensor, std::span<const std::complex<double>> undamped_rad_per_s) const {
  const auto zeros = [&](const auto& units) {
    return chain_damped_zeros(units, arm_.kelvin_voigt_s, sensor, undamped_rad_per_s);
  };
  return std::visit(zeros, units_);
}

arm::ModalModel TransferMatrixArm::modal_model(int count, std::span<const arm::Sensor> sensors,
                                               std::span<const double> stations_m) const {
  require_chain_count(count);
  const auto model = [&](const auto& units) {
    return chain_model(arm_, units, count, sensors, stations_m);
  };
  return std::visit(model, units_);
}

std::vector<arm::Mode> TransferMatrixArm::modes(int count, std::span<const arm::Sensor> sensors,
                                                std::span<const double> stations_m) const {
  auto model = modal_model(count, sensors, stations_m);
  model.modes.erase(model.modes.begin());
  return std::move(model.modes);
}

std::vector<std::complex<double>> TransferMatrixArm::transfer_functions(
    std::span<const arm::Sensor> sensors, std::complex<double> s_rad_per_s) const {
  const auto responses = [&](const auto& units) {
    return chain_responses(arm_, units, sensors, s_rad_per_s);
  };
  return std::visit(responses, units_);
}

}  // namespace flexarm::exact_tf
