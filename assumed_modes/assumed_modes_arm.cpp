#include "assumed_modes/assumed_modes_arm.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "assumed_modes/damped_poles.hpp"
#include "assumed_modes/output_row.hpp"
#include "assumed_modes/pencil_zeros.hpp"
#include "assumed_modes/trusted_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::assumed_modes {

static_assert(arm::Formulation<AssumedModesArm>);

namespace {

arm::Arm checked(arm::Arm arm) {
  arm::require_computable(arm);
  arm::require_honoured(arm.effects, AssumedModesArm::kName,
                        {"hub_inertia", "flexural_rigidity", "linear_density", "payload_mass",
                         "payload_inertia", "hub_viscous_friction", "structural_damping"});
  return arm;
}

AssumedModesOptions checked(AssumedModesOptions options) {
  if (options.functions < 2 || options.functions > kMaximumFunctions) {
    throw arm::out_of_range("functions", options.functions, "",
                            fmt::format("from 2 to {}", kMaximumFunctions));
  }
  if (!(options.zero_change > 0 && std::isfinite(options.zero_change))) {
    throw arm::out_of_range("zero_change", options.zero_change, "", "a finite number above 0");
  }
  return options;
}

InertiaRatios ratios_of(const arm::Arm& arm) {
  return {arm::hub_inertia_ratio(arm), arm::payload_mass_ratio(arm),
          arm::payload_inertia_ratio(arm)};
}

int kept(int count, Eigen::Index available) {
  arm::require_count(count);
  return std::min(count, static_cast<int>(available));
}

/// omega = scale sqrt(mu) of the first `count` eigenvalues.
std::vector<double> frequencies_rad_per_s(const RitzPairs& pairs, int count, double scale) {
  std::vector<double> omega;
  for (Eigen::Index k = 0; k < count; ++k) {
    omega.push_back(static_cast<double>(std::sqrt(pairs.eigenvalues(k)) * scale));
  }
  return omega;
}

arm::SolveSummary summary_of(const RitzPairs& pairs, const AssumedModesOptions& options) {
  return {fmt::format("Rayleigh-Ritz, {} functions ({}); residual |M q - q/mu| mu_1",
                      options.functions, to_string(options.basis)),
          0, static_cast<double>(pairs.largest_residual), pairs.converged};
}

}  // namespace

AssumedModesArm::AssumedModesArm(arm::Arm arm, Options options)
    : arm_(checked(std::move(arm))),
      linear_(arm::linear_arm(arm_)),
      options_(checked(options)),
      ratios_(ratios_of(arm_)),
      functions_(options_.basis, options_.functions - 1, ratios_),
      integrals_(functions_.integrals()),
      mass_(mass_matrix(integrals_, ratios_)),
      modes_(ritz_pairs(mass_.without_rigid_mode())),
      hub_slopes_(modes_.vectors.transpose() *
                  OutputRow{1, 1, integrals_.root_slope}.without_rigid_mode(mass_)) {}

arm::PoleSet AssumedModesArm::poles(int count) const {
  arm::PoleSet result;
  result.omega_rad_per_s = frequencies_rad_per_s(modes_, kept(count, modes_.eigenvalues.size()),
                                                 arm::omega_scale_rad_per_s(linear_));
  result.count.found = static_cast<int>(result.omega_rad_per_s.size());
  result.summary = summary_of(modes_, options_);
  return result;
}

arm::ZeroSet AssumedModesArm::zeros(const arm::Sensor& sensor, int count) const {
  arm::require_count(count);
  arm::require_valid(sensor, arm_);
  arm::require_responsive(sensor, arm_);
  return arm::is_collocated(sensor) ? hub_zeros(count) : output_zeros(sensor, count);
}

arm::ZeroSet AssumedModesArm::hub_zeros(int count) const {
  const MassMatrix without_hub =
      mass_matrix(integrals_, {0, ratios_.payload_mass, ratios_.payload_inertia});
  const RitzPairs pairs = ritz_pairs(clamped_root_mass(without_hub, integrals_.root_slope));
  arm::ZeroSet result;
  for (const double omega : frequencies_rad_per_s(pairs, kept(count, pairs.eigenvalues.size()),
                                                  arm::omega_scale_rad_per_s(linear_))) {
    result.s_rad_per_s.emplace_back(0.0, omega);
  }
  result.infinite = 2;
  result.count.found = static_cast<int>(result.s_rad_per_s.size());
  result.summary = summary_of(pairs, options_);
  return result;
}

arm::ZeroSet AssumedModesArm::output_zeros(const arm::Sensor& sensor, int count) const {
  // A zero keeps the tip still, so that the payload mass drops out; left in it would cancel.
  const bool tip_held = sensor.kind == arm::SensorKind::tip_acceleration ||
                        sensor.kind == arm::SensorKind::tip_displacement;
  const InertiaRatios moving = {0, tip_held ? 0 : ratios_.payload_mass, ratios_.payload_inertia};
  const auto with_more_functions = [&](int more) {
    const AdmissibleFunctions functions(options_.basis, options_.functions - 1 + more, ratios_);
    const Integrals integrals = functions.integrals();
    return pencil_zeros(mass_matrix(integrals, moving), integrals.root_slope,
                        output_row(sensor, arm_, functions));
  };
  const std::array checks = {with_more_functions(2), with_more_functions(4)};
  arm::ZeroSet result =
      trusted_zeros(with_more_functions(0), checks, options_.zero_change,
                    kept(count, modes_.eigenvalues.size()), arm::omega_scale_rad_per_s(linear_));
  result.summary.method = fmt::format(
      "Rosenbrock pencil on {0} functions ({1}); residual: relative change with {2} and {3}",
      options_.functions, to_string(options_.basis), options_.functions + 2,
      options_.functions + 4);
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
  const int available = kept(count, modes_.eigenvalues.size());
  const Real length = linear_.length_m;
  std::vector<OutputRow> sensor_rows;
  for (const arm::Sensor& sensor : sensors) {
    sensor_rows.push_back(output_row(sensor, arm_, functions_));
  }
  arm::require_stations(stations_m, arm_);
  std::vector<OutputRow> station_rows;
  for (const double station_m : stations_m) {
    station_rows.push_back({length, station_m / length, functions_.values(station_m / length, 0)});
  }

  arm::ModalModel model;
  model.modal_mass_kg_m2 = arm::total_inertia_kg_m2(linear_);
  arm::Mode& rigid = model.modes.emplace_back();
  rigid.hub_slope = 1.0;
  const auto shown_by_rigid = [](const OutputRow& row) {
    return static_cast<double>(row.unit * row.rigid);
  };
  std::ranges::transform(sensor_rows, std::back_inserter(rigid.sensor_values), shown_by_rigid);
  std::ranges::transform(station_rows, std::back_inserter(rigid.displacement_m), shown_by_rigid);
  for (Eigen::Index k = 0; k < available; ++k) {
    // A vector with q^T q = 1 has the modal mass 1/mu; the mode is to have the rigid rotation's.
    const Real sign = hub_slopes_(k) < 0 ? -1 : 1;
    const Real scale = sign * std::sqrt(mass_.rigid * modes_.eigenvalues(k));
    const auto values = [&](const std::vector<OutputRow>& rows) {
      std::vector<double> shown;
      for (const OutputRow& row : rows) {
        shown.push_back(static_cast<double>(
            row.unit * scale * row.without_rigid_mode(mass_).dot(modes_.vectors.col(k))));
      }
      return shown;
    };
    arm::Mode mode;
    mode.omega_rad_per_s =
        static_cast<double>(std::sqrt(modes_.eigenvalues(k)) * arm::omega_scale_rad_per_s(linear_));
    mode.hub_slope = static_cast<double>(scale * hub_slopes_(k));
    mode.sensor_values = values(sensor_rows);
    mode.displacement_m = values(station_rows);
    model.modes.push_back(std::move(mode));
  }
  for (const arm::Mode& i : model.modes) {
    for (const arm::Mode& j : model.modes) {
      const double bending =
          &i == &j ? linear_.kelvin_voigt_s * i.omega_rad_per_s * i.omega_rad_per_s : 0.0;
      model.damping_rad_per_s.push_back(bending + linear_.hub_viscous_friction_N_m_s_per_rad /
                                                      model.modal_mass_kg_m2 *
                                                      (i.hub_slope * j.hub_slope));
    }
  }
  for (std::size_t k = 1; k < model.modes.size(); ++k) {
    model.modes[k].damping_ratio = model.damping_rad_per_s[k * (model.modes.size() + 1)] /
                                   (2.0 * model.modes[k].omega_rad_per_s);
  }
  return model;
}

arm::DampedPoleSet AssumedModesArm::damped_poles(int count) const {
  const int available = kept(count, modes_.eigenvalues.size());
  const Eigen::Index n = modes_.eigenvalues.size() + 1;
  const Real scale = arm::omega_scale_rad_per_s(linear_);
  const Real torsion_N_m = linear_.flexural_rigidity_N_m2 / linear_.length_m;
  Vector hub = Vector::Ones(n);
  hub.tail(n - 1) = hub_slopes_;
  QuadraticPencil pencil{
      Vector::Constant(n, mass_.rigid), Vector::Ones(n),
      linear_.hub_viscous_friction_N_m_s_per_rad * scale / torsion_N_m * hub * hub.transpose()};
  pencil.mass.tail(n - 1) = modes_.eigenvalues.cwiseInverse();
  pencil.stiffness(0) = 0;
  pencil.damping.diagonal().tail(n - 1).array() += linear_.kelvin_voigt_s * scale;
  return assumed_modes::damped_poles(pencil, available, static_cast<double>(scale));
}

std::complex<double> AssumedModesArm::transfer_function(const arm::Sensor& sensor,
                                                        std::complex<double> s_rad_per_s) const {
  if (s_rad_per_s == 0.0) throw std::domain_error("transfer function at s = 0: a double pole");
  if (!std::isfinite(s_rad_per_s.real()) || !std::isfinite(s_rad_per_s.imag())) {
    throw std::domain_error("transfer function: s must be finite");
  }
  using Complex = std::complex<Real>;
  const OutputRow row = output_row(sensor, arm_, functions_);
  const Vector flexible = modes_.vectors.transpose() * row.without_rigid_mode(mass_);

  // Without hub friction K (1 + kv s) + sigma^2 M is diagonal in the modes; friction adds
  // c s a a^T, whose inverse the Sherman-Morrison formula gives.
  const Complex s(s_rad_per_s);
  const Real scale = arm::omega_scale_rad_per_s(linear_);
  const Complex sigma_squared = (s / scale) * (s / scale);
  const Complex stiffness = Real{1} + static_cast<Real>(linear_.kelvin_voigt_s) * s;
  const Complex rigid = Real{1} / (sigma_squared * mass_.rigid);
  Complex hub_response = rigid;
  Complex response = row.rigid * rigid;
  for (Eigen::Index k = 0; k < hub_slopes_.size(); ++k) {
    const Complex per_torque = hub_slopes_(k) / (stiffness + sigma_squared / modes_.eigenvalues(k));
    hub_response += hub_slopes_(k) * per_torque;
    response += flexible(k) * per_torque;
  }
  const Real compliance =
      static_cast<Real>(linear_.length_m) / static_cast<Real>(linear_.flexural_rigidity_N_m2);
  const Complex friction =
      static_cast<Real>(linear_.hub_viscous_friction_N_m_s_per_rad) * s * compliance;
  response *= row.unit * compliance / (Real{1} + friction * hub_response);
  for (int order = arm::derivative_order(sensor); order > 0; --order) response *= s;
  return std::complex<double>(response);
}

Eigen::MatrixXd AssumedModesArm::mass_matrix_kg_m2() const {
  const Real unit = static_cast<Real>(linear_.linear_density_kg_per_m) *
                    std::pow(static_cast<Real>(linear_.length_m), 3);
  return (unit * mass_.assembled()).cast<double>();
}

Eigen::MatrixXd AssumedModesArm::stiffness_matrix_N_m() const {
  const double unit = linear_.flexural_rigidity_N_m2 / linear_.length_m;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(options_.functions, unit);
  diagonal(0) = 0.0;
  return diagonal.asDiagonal();
}

}  // namespace flexarm::assumed_modes
