#include "assumed_modes/assumed_modes_arm.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "assumed_modes/damped_poles.hpp"
#include "assumed_modes/forced_response.hpp"
#include "assumed_modes/output_row.hpp"
#include "assumed_modes/output_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::assumed_modes {

static_assert(arm::Formulation<AssumedModesArm>);

namespace {

arm::Arm checked(arm::Arm arm) {
  arm::require_computable(arm);
  arm::require_honoured(arm.effects, AssumedModesArm::kName, arm::kLinearArmPorts);
  return arm;
}

AssumedModesOptions checked(AssumedModesOptions options, const arm::Arm& arm) {
  if (options.functions < 2 || options.functions > kMaximumFunctions) {
    throw arm::out_of_range("functions", options.functions, "",
                            fmt::format("from 2 to {}", kMaximumFunctions));
  }
  if (!(options.zero_change > 0 && std::isfinite(options.zero_change))) {
    throw arm::out_of_range("zero_change", options.zero_change, "", "a finite number above 0");
  }
  require_representable(options.basis, arm);
  return options;
}

RitzPairs standing(RitzPairs modes, const arm::LinearArm& arm) {
  if (modes.eigenvalues(1) <= 0) {
    throw arm::out_of_range("effects.gravity.acceleration", arm.gravity_m_per_s2, "m/s^2",
                            "closer to 0: the inverted arm buckles");
  }
  return modes;
}

int kept(int count, Eigen::Index available) {
  arm::require_count(count);
  return std::min(count, static_cast<int>(available));
}

/// Values of rows in the modes, in SI.
Vector values_in(const RitzPairs& modes, const OutputRow& output) {
  return output.unit * (modes.vectors.transpose() * output.row);
}

}  // namespace

AssumedModesArm::AssumedModesArm(arm::Arm arm, Options options)
    : arm_(checked(std::move(arm))),
      linear_(arm::linear_arm(arm_)),
      options_(checked(options, arm_)),
      scaled_(scaled(linear_)),
      functions_(options_.basis, scaled_, options_.functions),
      pencil_(equations_of(functions_, scaled_)),
      modes_(standing(undamped_modes(pencil_, scaled_.turns_freely()), linear_)),
      damping_(modal_damping(functions_, scaled_, modes_)) {}

arm::PoleSet AssumedModesArm::poles(int count) const {
  const double scale = arm::omega_scale_rad_per_s(linear_);
  arm::PoleSet result;
  for (Eigen::Index k = 1; k <= kept(count, modes_.mass.size() - 1); ++k) {
    result.omega_rad_per_s.push_back(static_cast<double>(std::sqrt(modes_.eigenvalues(k)) * scale));
  }
  result.lowest_omega_squared_rad2_per_s2 =
      static_cast<double>(modes_.eigenvalues(0) * scale * scale);
  result.count.found = static_cast<int>(result.omega_rad_per_s.size());
  result.summary = summary_of(modes_);
  return result;
}

arm::ZeroSet AssumedModesArm::zeros(const arm::Sensor& sensor, int count) const {
  arm::require_count(count);
  const arm::Sensor at = arm::placed(sensor, arm_);
  arm::require_responsive(sensor, arm_);
  if (arm::is_collocated(sensor)) return hub_zeros(count);
  return output_zeros(at, linear_, {options_.basis, options_.functions, options_.zero_change},
                      kept(count, modes_.mass.size() - 1));
}

arm::ZeroSet AssumedModesArm::hub_zeros(int count) const {
  const RitzPairs pairs = hub_held_values(pencil_);
  const double scale = arm::omega_scale_rad_per_s(linear_);
  arm::ZeroSet result;
  for (Eigen::Index k = 0; k < kept(count, pairs.mass.size()); ++k) {
    const Real mu = pairs.eigenvalues(k);
    const auto size = static_cast<double>(std::sqrt(std::abs(mu)) * scale);
    result.s_rad_per_s.emplace_back(mu < 0 ? size : 0.0, mu < 0 ? 0.0 : size);
  }
  std::ranges::stable_sort(result.s_rad_per_s, {}, [](const auto& s) { return std::abs(s); });
  result.infinite = 2;
  result.count.found = static_cast<int>(result.s_rad_per_s.size());
  result.summary = summary_of(pairs);
  return result;
}

std::vector<arm::Mode> AssumedModesArm::modes(int count, std::span<const arm::Sensor> sensors,
                                              std::span<const double> stations_m) const {
  std::vector<arm::Mode> result = modal_model(count, sensors, stations_m).modes;
  result.erase(result.begin());
  return result;
}

arm::ModalModel AssumedModesArm::modal_model(int count, std::span<const arm::Sensor> sensors,
                                             std::span<const double> stations_m) const {
  const Eigen::Index shown = kept(count, modes_.mass.size() - 1) + 1;
  const Real length = linear_.length_m;
  const Real scale = arm::omega_scale_rad_per_s(linear_);
  arm::require_stations(stations_m, arm_);

  arm::ModalModel model;
  model.modal_mass_kg_m2 = arm::total_inertia_kg_m2(linear_);
  model.lowest_omega_squared_rad2_per_s2 =
      static_cast<double>(modes_.eigenvalues(0) * scale * scale);
  model.modes.resize(static_cast<std::size_t>(shown));
  // q^T M q becomes M_00, the inertia of the rigid arm, and the hub turns forward.
  const Vector signs =
      (damping_.hub_rotation.array() < 0)
          .select(-Vector::Ones(modes_.mass.size()), Vector::Ones(modes_.mass.size()));
  const Vector amplitude = signs.array() * (pencil_.mass()(0, 0) / modes_.mass.array()).sqrt();
  const auto for_each_mode = [&](const OutputRow& row, auto&& take) {
    const Vector values = values_in(modes_, row).cwiseProduct(amplitude);
    for (Eigen::Index k = 0; k < shown; ++k) {
      take(model.modes[static_cast<std::size_t>(k)], static_cast<double>(values(k)));
    }
  };
  for_each_mode({1, functions_.motor_rotation()},
                [](arm::Mode& mode, double value) { mode.hub_slope = value; });
  for (const arm::Sensor& sensor : sensors) {
    for_each_mode(output_row(arm::placed(sensor, arm_), linear_, functions_),
                  [](arm::Mode& mode, double value) { mode.sensor_values.push_back(value); });
  }
  for (const double station_m : stations_m) {
    for_each_mode({length, functions_.displacement(station_m / length)},
                  [](arm::Mode& mode, double value) { mode.displacement_m.push_back(value); });
  }

  const Matrix damping = amplitude.asDiagonal() * damping_.whole * amplitude.asDiagonal() *
                         (scale / pencil_.mass()(0, 0));
  for (Eigen::Index i = 0; i < shown; ++i) {
    for (Eigen::Index j = 0; j < shown; ++j) {
      model.damping_rad_per_s.push_back(
          static_cast<double>(damping(std::max(i, j), std::min(i, j))));
    }
    arm::Mode& mode = model.modes[static_cast<std::size_t>(i)];
    mode.omega_rad_per_s =
        static_cast<double>(std::sqrt(std::max(Real{0}, modes_.eigenvalues(i))) * scale);
    if (mode.omega_rad_per_s > 0.0) {
      mode.damping_ratio = static_cast<double>(damping(i, i)) / (2.0 * mode.omega_rad_per_s);
    }
  }
  return model;
}

arm::DampedPoleSet AssumedModesArm::damped_poles(int count) const {
  const int flexible = kept(count, modes_.mass.size() - 1);
  return assumed_modes::damped_poles({modes_.mass, modes_.stiffness, damping_.whole}, flexible,
                                     arm::omega_scale_rad_per_s(linear_));
}

std::complex<double> AssumedModesArm::transfer_function(const arm::Sensor& sensor,
                                                        std::complex<double> s_rad_per_s) const {
  const arm::Sensor at = arm::placed(sensor, arm_);
  if (s_rad_per_s == 0.0 && linear_.turns_freely()) {
    throw std::domain_error("transfer function at s = 0: a double pole");
  }
  if (!std::isfinite(s_rad_per_s.real()) || !std::isfinite(s_rad_per_s.imag())) {
    throw std::domain_error("transfer function: s must be finite");
  }
  using Complex = std::complex<Real>;
  const Complex s(s_rad_per_s);
  const Real scale = arm::omega_scale_rad_per_s(linear_);
  Complex response =
      forced_response(modes_, damping_, values_in(modes_, output_row(at, linear_, functions_)),
                      s / scale) /
      torsion_N_m();
  for (int order = arm::derivative_order(sensor); order > 0; --order) response *= s;
  return std::complex<double>(response);
}

Eigen::MatrixXd AssumedModesArm::mass_matrix_kg_m2() const {
  const Real unit = static_cast<Real>(linear_.linear_density_kg_per_m) *
                    std::pow(static_cast<Real>(linear_.length_m), 3);
  return (unit * pencil_.mass()).cast<double>();
}

Eigen::MatrixXd AssumedModesArm::stiffness_matrix_N_m() const {
  return (torsion_N_m() * pencil_.stiffness()).cast<double>();
}

Eigen::MatrixXd AssumedModesArm::damping_matrix_N_m_s() const {
  const Real unit = torsion_N_m() / static_cast<Real>(arm::omega_scale_rad_per_s(linear_));
  RitzPairs unreduced;
  unreduced.vectors = Matrix::Identity(pencil_.size(), pencil_.size());
  unreduced.mass = Vector::Ones(pencil_.size());
  unreduced.stiffness = functions_.bends();
  return (unit * modal_damping(functions_, scaled_, unreduced).whole).cast<double>();
}

arm::SolveSummary AssumedModesArm::summary_of(const RitzPairs& pairs) const {
  return {fmt::format("Rayleigh-Ritz, {} functions ({}); residual |C z - nu z|/nu_1 of "
                      "nu = 1/(mu + shift)",
                      pencil_.size(), to_string(options_.basis)),
          0, static_cast<double>(pairs.largest_residual), pairs.converged};
}

Real AssumedModesArm::torsion_N_m() const {
  return static_cast<Real>(linear_.flexural_rigidity_N_m2) / static_cast<Real>(linear_.length_m);
}

}  // namespace flexarm::assumed_modes
