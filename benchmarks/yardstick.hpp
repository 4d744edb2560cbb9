#pragma once

#include "arm/formulation.hpp"
#include "exact_tf/exact_arm.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

namespace flexarm::benchmarks {

// What every formulation is asked for, and its errors against exact_tf on the same arm.

inline constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle};
inline constexpr arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration};

/// The roots of the figures.
inline constexpr int kPoles = 10;
inline constexpr int kHubZeros = 10;
inline constexpr int kTipZeros = 6;

/// The paper's arm with both dampings, whose response has no pole on the imaginary axis.
inline arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 1e-3;
  return arm;
}

/// max |found - exact|/|exact| over what was found; NaN where nothing was.
template <class Number>
double worst_relative_error(const std::vector<Number>& found, const std::vector<Number>& exact) {
  if (found.empty()) return std::numeric_limits<double>::quiet_NaN();
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    worst = std::max(worst, std::abs(found[i] - exact[i]) / std::abs(exact[i]));
  }
  return worst;
}

template <arm::Formulation Model>
double error_of_poles(const Model& model) {
  return worst_relative_error(model.poles(kPoles).omega_rad_per_s,
                              exact_tf::ExactArm(model.arm()).poles(kPoles).omega_rad_per_s);
}

template <arm::Formulation Model>
double error_of_zeros(const Model& model, const arm::Sensor& sensor, int count) {
  return worst_relative_error(model.zeros(sensor, count).s_rad_per_s,
                              exact_tf::ExactArm(model.arm()).zeros(sensor, count).s_rad_per_s);
}

template <arm::Formulation Model>
double error_of_poles_and_hub_zeros(const Model& model) {
  return std::max(error_of_poles(model), error_of_zeros(model, kHubAngle, kHubZeros));
}

/// s = i omega, 64 frequencies from 0.1 to 200 Hz at equal ratios: past the fifth pole of the
/// paper's arm.
inline std::vector<std::complex<double>> frequency_points() {
  constexpr int kCount = 64;
  std::vector<std::complex<double>> points;
  for (int i = 0; i < kCount; ++i) {
    const double frequency_Hz = 0.1 * std::pow(2000.0, i / (kCount - 1.0));
    points.emplace_back(0.0, 2.0 * std::numbers::pi * frequency_Hz);
  }
  return points;
}

template <arm::Formulation Model>
std::vector<std::complex<double>> responses(const Model& model, const arm::Sensor& sensor,
                                            const std::vector<std::complex<double>>& points) {
  std::vector<std::complex<double>> values;
  for (const auto s : points) values.push_back(model.transfer_function(sensor, s));
  return values;
}

template <arm::Formulation Model>
double error_of_responses(const Model& model, const arm::Sensor& sensor) {
  const auto points = frequency_points();
  return worst_relative_error(responses(model, sensor, points),
                              responses(exact_tf::ExactArm(model.arm()), sensor, points));
}

}  // namespace flexarm::benchmarks
