#include "fem/fem_arm.hpp"

#include "arm/input_error.hpp"
#include "fem/discretisation.hpp"
#include "fem/hub_driven_response.hpp"
#include "fem/sensor_row.hpp"
#include "fem/trusted_zeros.hpp"
#include "fem/vibration_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace flexarm::fem {

namespace {

using Complex = std::complex<double>;

arm::Arm checked(arm::Arm arm) {
  arm::require_computable(arm);
  arm::require_honoured(arm.effects, FemArm::kName, {});
  return arm;
}

FemArm::Options checked(FemArm::Options options) {
  const auto require_from = [](const char* key, int value, int lowest, int highest) {
    if (value < lowest || value > highest) {
      throw arm::out_of_range(key, value, "", fmt::format("{} to {}", lowest, highest));
    }
  };
  const auto require_fraction = [](const char* key, double value) {
    if (!(value > 0.0 && value < 1.0)) {
      throw arm::out_of_range(key, value, "", "above 0 and below 1");
    }
  };
  require_from("degree", options.degree, HermiteElement::kLowestDegree, FemArm::kHighestDegree);
  require_from("checking_degrees", options.checking_degrees, 1, FemArm::kMostCheckingDegrees);
  require_fraction("eigen_tolerance", options.eigen_tolerance);
  require_fraction("zero_agreement", options.zero_agreement);
  return options;
}

arm::SolveSummary summary_of(const VibrationModes& modes, const arm::RootCount& count) {
  return {modes.dense ? "singular values of the factored stiffness, inverse iteration (residual: "
                        "last change of omega^2)"
                      : "Lanczos on the factored flexibility, inverse iteration (residual: last "
                        "change of omega^2)",
          modes.iterations, modes.largest_change,
          modes.converged && (count.expected < 0 || count.found == count.expected)};
}

/// Eigenvalues up to the highest of `modes`, by Sylvester inertia.
arm::RootCount count_of(const Discretisation& model, HubSupport support,
                        const VibrationModes& modes) {
  // Just above the highest mode: far more than its rounding, far less than the gap to the next.
  constexpr double kAbove = 1.0 + 1e-6;
  const Eigen::Index found = modes.omega_squared.size();
  const int rigid = support == HubSupport::free ? 1 : 0;
  const int below = eigenvalues_below(model, support, modes.omega_squared[found - 1] * kAbove);
  return {static_cast<int>(found), below < 0 ? -1 : below - rigid, "Sylvester inertia"};
}

std::vector<double> frequencies(const VibrationModes& modes, double omega_scale) {
  std::vector<double> omega;
  for (const double squared : modes.omega_squared)
    omega.push_back(omega_scale * std::sqrt(squared));
  return omega;
}

}  // namespace

FemArm::FemArm(arm::Arm arm) : FemArm(std::move(arm), Options{}) {}

FemArm::FemArm(arm::Arm arm, Options options)
    : arm_(checked(std::move(arm))),
      options_(checked(std::move(options))),
      omega_scale_rad_per_s_(arm::omega_scale_rad_per_s(arm_)),
      model_(std::make_shared<const Discretisation>(arm_, options_.mesh, options_.degree)) {}

int FemArm::degrees_of_freedom() const {
  return model_->size();
}

arm::PoleSet FemArm::poles(int count) const {
  arm::require_count(count);
  const VibrationModes modes =
      vibration_modes(*model_, HubSupport::free, count, options_.eigen_tolerance);
  arm::PoleSet poles;
  poles.omega_rad_per_s = frequencies(modes, omega_scale_rad_per_s_);
  poles.count = count_of(*model_, HubSupport::free, modes);
  poles.summary = summary_of(modes, poles.count);
  return poles;
}

arm::ZeroSet FemArm::zeros(const arm::Sensor& sensor, int count) const {
  arm::require_count(count);
  arm::require_valid(sensor, arm_);
  arm::require_responsive(sensor, arm_);
  // A model has fewer roots than coordinates.
  count = std::min(count, degrees_of_freedom());
  return arm::is_collocated(sensor) ? clamped_zeros(count) : transmission_zeros(sensor, count);
}

arm::ZeroSet FemArm::clamped_zeros(int count) const {
  const VibrationModes modes =
      vibration_modes(*model_, HubSupport::clamped, count, options_.eigen_tolerance);
  arm::ZeroSet zeros;
  for (const double omega : frequencies(modes, omega_scale_rad_per_s_)) {
    zeros.s_rad_per_s.emplace_back(0.0, omega);
  }
  zeros.count = count_of(*model_, HubSupport::clamped, modes);
  zeros.summary = summary_of(modes, zeros.count);
  return zeros;
}

arm::ZeroSet FemArm::transmission_zeros(const arm::Sensor& sensor, int count) const {
  const auto finer = [&](int degrees) {
    return Discretisation(arm_, options_.mesh, options_.degree + degrees);
  };
  const CheckingModels checking{finer(options_.checking_degrees),
                                finer(2 * options_.checking_degrees)};
  arm::ZeroSet zeros = trusted_zeros(*model_, checking, arm_, sensor, count,
                                     {options_.eigen_tolerance, options_.zero_agreement});
  for (Complex& s : zeros.s_rad_per_s) s *= omega_scale_rad_per_s_;
  for (arm::RejectedZero& zero : zeros.rejected) zero.s_rad_per_s *= omega_scale_rad_per_s_;
  return zeros;
}

std::vector<arm::Mode> FemArm::modes(int count, std::span<const arm::Sensor> sensors,
                                     std::span<const double> stations_m) const {
  arm::require_count(count);
  std::vector<SensorRow> rows;
  for (const arm::Sensor& sensor : sensors) {
    arm::require_valid(sensor, arm_);
    rows.push_back(sensor_row(*model_, arm_, sensor));
  }
  const double length_m = arm_.beam.length_m;
  arm::require_stations(stations_m, arm_);
  const VibrationModes vibration =
      vibration_modes(*model_, HubSupport::free, count, options_.eigen_tolerance);
  const double friction = arm_.hub.viscous_friction_N_m_s_per_rad / arm::total_inertia_kg_m2(arm_);

  std::vector<arm::Mode> modes;
  for (Eigen::Index j = 0; j < vibration.omega_squared.size(); ++j) {
    const double omega_squared = vibration.omega_squared[j];
    // Unit modal mass to total inertia; a positive hub slope.
    const double size = std::sqrt(model_->total_inertia());
    const Eigen::VectorXd phi =
        vibration.shapes.col(j) * (vibration.shapes(0, j) < 0.0 ? -size : size);
    arm::Mode mode;
    mode.omega_rad_per_s = omega_scale_rad_per_s_ * std::sqrt(omega_squared);
    mode.hub_slope = phi[0];
    const double omega = mode.omega_rad_per_s;
    mode.damping_ratio =
        (arm_.damping.kelvin_voigt_s * omega * omega + friction * mode.hub_slope * mode.hub_slope) /
        (2.0 * omega);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double reading = rows[i].c.dot(phi) * (rows[i].by_inertia ? omega_squared : 1.0);
      mode.sensor_values.push_back(reading * si_reading(arm_, sensors[i]));
    }
    for (const double station_m : stations_m) {
      mode.displacement_m.push_back(length_m * model_->deflection(phi, station_m / length_m));
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

Complex FemArm::transfer_function(const arm::Sensor& sensor, Complex s_rad_per_s) const {
  arm::require_valid(sensor, arm_);
  if (s_rad_per_s == 0.0) {
    throw std::domain_error("transfer function: s = 0 is the pole of the rigid arm");
  }
  if (!std::isfinite(std::norm(s_rad_per_s / omega_scale_rad_per_s_))) {
    throw std::domain_error("transfer function: the square of s is not finite");
  }
  const double rigidity = arm_.beam.flexural_rigidity_N_m2();
  const Complex s = s_rad_per_s / omega_scale_rad_per_s_;
  const Complex stiffness_factor = 1.0 + arm_.damping.kelvin_voigt_s * s_rad_per_s;
  const double friction = arm_.hub.viscous_friction_N_m_s_per_rad * omega_scale_rad_per_s_ *
                          arm_.beam.length_m / rigidity;
  const HubDrivenResponse response(*model_, stiffness_factor, s * s);
  if (response.singular()) {
    // Exactly at a zero of the hub angle parts of the ratios below are infinite; beside it not.
    constexpr double kBeside = 1.0 + 4.0 * std::numeric_limits<double>::epsilon();
    return transfer_function(sensor, s_rad_per_s * kBeside);
  }
  const Eigen::VectorXcd u = response.to_unit_rotation();
  // Angular momentum about the axis: no stress enters, so nothing cancels as s tends to 0.
  const Complex torque =
      s * s * model_->rigid_momentum().cast<Complex>().cwiseProduct(u).sum() + friction * s;
  const SensorRow row = sensor_row(*model_, arm_, sensor);
  Complex reading = row.c.cast<Complex>().cwiseProduct(u).sum();
  if (row.by_inertia) reading *= -s * s / stiffness_factor;
  const double torque_unit_N_m = rigidity / arm_.beam.length_m;
  return reading / torque * si_reading(arm_, sensor) / torque_unit_N_m *
         std::pow(s_rad_per_s, arm::derivative_order(sensor));
}

Eigen::SparseMatrix<double> FemArm::mass_kg_m2() const {
  return model_->mass() * (arm_.beam.linear_density_kg_per_m() * std::pow(arm_.beam.length_m, 3));
}

Eigen::SparseMatrix<double> FemArm::stiffness_N_m() const {
  return model_->stiffness() * (arm_.beam.flexural_rigidity_N_m2() / arm_.beam.length_m);
}

}  // namespace flexarm::fem
