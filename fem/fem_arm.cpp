#include "fem/fem_arm.hpp"

#include "arm/input_error.hpp"
#include "fem/damped_poles.hpp"
#include "fem/discretisation.hpp"
#include "fem/hub_driven_response.hpp"
#include "fem/modal_model.hpp"
#include "fem/sensor_row.hpp"
#include "fem/standing_arm.hpp"
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
  arm::require_honoured(arm.effects, FemArm::kName, arm::kLinearArmPorts);
  require_unbuckled(arm::linear_arm(arm));
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
  require_from("degree", options.degree, BeamElement::kLowestDegree, FemArm::kHighestDegree);
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

}  // namespace

FemArm::FemArm(arm::Arm arm) : FemArm(std::move(arm), Options{}) {}

FemArm::FemArm(arm::Arm arm, Options options)
    : arm_(checked(std::move(arm))),
      options_(checked(std::move(options))),
      linear_(arm::linear_arm(arm_)),
      omega_scale_rad_per_s_(arm::omega_scale_rad_per_s(linear_)),
      model_(std::make_shared<const Discretisation>(linear_, options_.mesh, options_.degree)) {}

int FemArm::degrees_of_freedom() const {
  return model_->size();
}

arm::PoleSet FemArm::poles(int count) const {
  arm::require_count(count);
  const VibrationModes modes =
      vibration_modes(*model_, HubSupport::free, count, options_.eigen_tolerance);
  arm::PoleSet poles;
  for (const double squared : modes.omega_squared) {
    poles.omega_rad_per_s.push_back(omega_scale_rad_per_s_ * std::sqrt(squared));
  }
  poles.lowest_omega_squared_rad2_per_s2 =
      modes.lowest_omega_squared * omega_scale_rad_per_s_ * omega_scale_rad_per_s_;
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
  return arm::is_collocated(sensor) ? clamped_zeros(count)
                                    : transmission_zeros(arm::placed(sensor, arm_), count);
}

arm::ZeroSet FemArm::clamped_zeros(int count) const {
  const VibrationModes modes =
      vibration_modes(*model_, HubSupport::clamped, count, options_.eigen_tolerance);
  arm::ZeroSet zeros;
  for (const double squared : modes.omega_squared) {
    // Below 0 where the arm stands up and buckles with its hub held.
    const double size = omega_scale_rad_per_s_ * std::sqrt(std::abs(squared));
    zeros.s_rad_per_s.push_back(squared >= 0.0 ? Complex(0.0, size) : Complex(size, 0.0));
  }
  std::ranges::sort(zeros.s_rad_per_s, {}, [](Complex s) { return std::abs(s); });
  zeros.count = count_of(*model_, HubSupport::clamped, modes);
  zeros.summary = summary_of(modes, zeros.count);
  return zeros;
}

arm::ZeroSet FemArm::transmission_zeros(const arm::Sensor& sensor, int count) const {
  const auto finer = [&](int degrees) {
    return Discretisation(linear_, options_.mesh, options_.degree + degrees);
  };
  const CheckingModels checking{finer(options_.checking_degrees),
                                finer(2 * options_.checking_degrees)};
  arm::ZeroSet zeros = trusted_zeros(*model_, checking, sensor, count,
                                     {options_.eigen_tolerance, options_.zero_agreement});
  for (Complex& s : zeros.s_rad_per_s) s *= omega_scale_rad_per_s_;
  for (arm::RejectedZero& zero : zeros.rejected) zero.s_rad_per_s *= omega_scale_rad_per_s_;
  return zeros;
}

std::vector<arm::Mode> FemArm::modes(int count, std::span<const arm::Sensor> sensors,
                                     std::span<const double> stations_m) const {
  arm::ModalModel model = modal_model(count, sensors, stations_m);
  model.modes.erase(model.modes.begin());
  return std::move(model.modes);
}

arm::ModalModel FemArm::modal_model(int count, std::span<const arm::Sensor> sensors,
                                    std::span<const double> stations_m) const {
  arm::require_count(count);
  const std::vector<arm::Sensor> at = arm::placed(sensors, arm_);
  arm::require_stations(stations_m, arm_);
  return fem::modal_model(
      *model_, vibration_modes(*model_, HubSupport::free, count, options_.eigen_tolerance), at,
      stations_m);
}

arm::DampedPoleSet FemArm::damped_poles(int count) const {
  arm::require_count(count);
  const DampedRoots roots = damped_roots(*model_, count, options_.eigen_tolerance);
  const auto in_SI = [&](const RootPair& pair) {
    return arm::PolePair{pair.first * omega_scale_rad_per_s_, pair.second * omega_scale_rad_per_s_};
  };
  arm::DampedPoleSet poles;
  poles.lowest = in_SI(roots.pairs.front());
  for (std::size_t i = 1; i < roots.pairs.size(); ++i) {
    poles.flexible.push_back(in_SI(roots.pairs[i]));
  }
  poles.summary = {
      "continuation in damping on projected modes, inverse iteration on the quadratic pencil "
      "(residual: last change of s)",
      roots.iterations, roots.largest_change, roots.converged};
  return poles;
}

Complex FemArm::transfer_function(const arm::Sensor& sensor, Complex s_rad_per_s) const {
  const arm::Sensor at = arm::placed(sensor, arm_);
  if (s_rad_per_s == 0.0 && model_->turns_freely()) {
    throw std::domain_error("transfer function: s = 0 is the pole of the rigid arm");
  }
  if (!std::isfinite(std::norm(s_rad_per_s / omega_scale_rad_per_s_))) {
    throw std::domain_error("transfer function: the square of s is not finite");
  }
  const Complex s = s_rad_per_s / omega_scale_rad_per_s_;
  const HubDrivenResponse<Complex> response(*model_, damped_dynamics(*model_, s));
  if (response.singular()) {
    // Exactly at a zero of the hub angle parts of the ratios below are infinite; beside it not.
    constexpr double kBeside = 1.0 + 4.0 * std::numeric_limits<double>::epsilon();
    return transfer_function(sensor, s_rad_per_s * kBeside);
  }
  const Eigen::VectorXcd u = response.to_unit_rotation().u;
  Complex reading = SensorRow(*model_, at).reading(u, s) * si_reading(linear_, at);
  for (int i = 0; i < arm::derivative_order(sensor); ++i) reading *= s_rad_per_s;
  const double torque_unit_N_m = linear_.flexural_rigidity_N_m2 / linear_.length_m;
  return reading / response.hub_torque(u) / torque_unit_N_m;
}

Eigen::SparseMatrix<double> FemArm::mass_kg_m2() const {
  return model_->mass() * (linear_.linear_density_kg_per_m * std::pow(linear_.length_m, 3));
}

Eigen::SparseMatrix<double> FemArm::stiffness_N_m() const {
  return model_->stiffness() * (linear_.flexural_rigidity_N_m2 / linear_.length_m);
}

Eigen::SparseMatrix<double> FemArm::damping_N_m_s() const {
  return model_->damping() *
         (linear_.flexural_rigidity_N_m2 / linear_.length_m / omega_scale_rad_per_s_);
}

}  // namespace flexarm::fem
