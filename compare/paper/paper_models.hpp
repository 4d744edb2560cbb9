#pragma once

#include "arm/arm.hpp"
#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "compare/paper/paper_check.hpp"
#include "exact_tf/exact_arm.hpp"
#include "fem/fem_arm.hpp"

#include <algorithm>
#include <complex>
#include <numbers>
#include <vector>

namespace flexarm::compare::paper {

/// The paper's arm with a payload mass: enough to show what each term of a tip condition does.
arm::Arm arm_with_payload_mass();
/// The same with a payload inertia as well.
arm::Arm arm_with_payload();
/// The paper's arm with Kelvin-Voigt damping that gives mode 1 the damping ratio of Table 6.
arm::Arm arm_with_damping();
/// The paper's arm with viscous friction at the hub.
arm::Arm arm_with_hub_friction();
/// The paper's arm with another hub inertia.
arm::Arm arm_with_hub_inertia(double inertia_kg_m2);

/// One arm in the three formulations, each with its default options.
struct ThreeModels {
  explicit ThreeModels(const arm::Arm& arm) : exact_tf(arm), fem(arm), assumed_modes(arm) {}

  exact_tf::ExactArm exact_tf;
  fem::FemArm fem;
  assumed_modes::AssumedModesArm assumed_modes;

  /// `question(model)` put to each.
  template <class Question>
  ByFormulation ask(const Question& question) const {
    return {question(exact_tf), question(fem), question(assumed_modes)};
  }
};

inline double in_Hz(double omega_rad_per_s) {
  return omega_rad_per_s / (2.0 * std::numbers::pi);
}
inline double from_Hz(double frequency_Hz) {
  return frequency_Hz * 2.0 * std::numbers::pi;
}

/// Frequency of the root lambda, omega = lambda^2 sqrt(EI/(m l^4)).
inline double lambda_to_Hz(const arm::Arm& arm, double lambda) {
  return in_Hz(lambda * lambda * arm::omega_scale_rad_per_s(arm));
}

/// Pole `order`, counted from 1 [Hz].
template <arm::Formulation F>
double pole_Hz(const F& model, int order) {
  return in_Hz(model.poles(order).omega_rad_per_s.at(static_cast<std::size_t>(order) - 1));
}

/// |s|/2 pi of zero `order` of a sensor [Hz].
template <arm::Formulation F>
double zero_Hz(const F& model, const arm::Sensor& sensor, int order) {
  const auto zeros = model.zeros(sensor, order).s_rad_per_s;
  return in_Hz(std::abs(zeros.at(static_cast<std::size_t>(order) - 1)));
}

/// Mode `order` with its values at one sensor.
template <arm::Formulation F>
arm::Mode mode(const F& model, int order, const arm::Sensor& sensor = {}) {
  const std::vector<arm::Sensor> sensors{sensor};
  return model.modes(order, sensors, {}).at(static_cast<std::size_t>(order) - 1);
}

/// phi_i of a sensor, time derivatives left out.
template <arm::Formulation F>
double mode_value(const F& model, int order, const arm::Sensor& sensor) {
  return mode(model, order, sensor).sensor_values.at(0);
}

/// |G(j omega)| of a sensor.
template <arm::Formulation F>
double magnitude(const F& model, const arm::Sensor& sensor, double omega_rad_per_s) {
  return std::abs(model.transfer_function(sensor, {0.0, omega_rad_per_s}));
}

/// I_T of the undamped arm from 1/(s^2 G(s)) well below its first hub zero, at Omega_1/10^4: the
/// next term of the series is smaller by 10^-8 or so.
template <arm::Formulation F>
double low_frequency_inertia_kg_m2(const F& model) {
  const arm::Sensor hub_angle{arm::SensorKind::hub_angle};
  const double omega = 1e-4 * std::abs(model.zeros(hub_angle, 1).s_rad_per_s.at(0));
  return 1.0 / (omega * omega * magnitude(model, hub_angle, omega));
}
inline constexpr double kLowFrequencyTolerance = 1e-6;

inline constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle};
inline constexpr arm::Sensor kHubVelocity{arm::SensorKind::hub_velocity};
inline constexpr arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration};
inline constexpr arm::Sensor kTipDisplacement{arm::SensorKind::tip_displacement};
inline constexpr arm::Sensor kTipDeflection{arm::SensorKind::tip_deflection};

/// int m phi_i phi_j dx + Ih phi_i'(0) phi_j'(0) + Mp phi_i(l) phi_j(l), over I_T, for an arm
/// without payload inertia; `linear_density` stands for m.
template <arm::Formulation F>
double inertia_product(const F& model, int i, int j, double linear_density);

/// int EI phi_i'' phi_j'' dx over I_T [rad^2/s^2], from the strains of the modes.
template <arm::Formulation F>
double stiffness_product(const F& model, int i, int j);

/// Points and weights on [0, l] that integrate products of the first few modes to about 1e-12.
struct Stations {
  std::vector<double> position_m;
  std::vector<double> weight_m;
};
Stations stations(double length_m);

template <arm::Formulation F>
double inertia_product(const F& model, int i, int j, double linear_density) {
  const arm::Arm& arm = model.arm();
  const auto points = stations(arm.beam.length_m);
  const std::vector<arm::Sensor> sensors{kTipDisplacement};
  const auto modes = model.modes(std::max(i, j), sensors, points.position_m);
  const auto& a = modes.at(static_cast<std::size_t>(i) - 1);
  const auto& b = modes.at(static_cast<std::size_t>(j) - 1);
  double sum = arm.hub.inertia_kg_m2 * a.hub_slope * b.hub_slope +
               arm.payload.mass_kg * a.sensor_values[0] * b.sensor_values[0];
  for (std::size_t k = 0; k < points.position_m.size(); ++k) {
    sum += points.weight_m[k] * linear_density * a.displacement_m[k] * b.displacement_m[k];
  }
  return sum / arm::total_inertia_kg_m2(arm);
}

template <arm::Formulation F>
double stiffness_product(const F& model, int i, int j) {
  const arm::Arm& arm = model.arm();
  const auto points = stations(arm.beam.length_m);
  std::vector<arm::Sensor> gauges;
  for (const double x : points.position_m) gauges.push_back({arm::SensorKind::strain, x});
  const auto modes = model.modes(std::max(i, j), gauges, {});
  const auto& a = modes.at(static_cast<std::size_t>(i) - 1);
  const auto& b = modes.at(static_cast<std::size_t>(j) - 1);
  const double half_thickness_m = 0.5 * *arm.beam.thickness_m;
  double sum = 0.0;
  for (std::size_t k = 0; k < gauges.size(); ++k) {
    sum += points.weight_m[k] * a.sensor_values[k] * b.sensor_values[k];
  }
  return arm.beam.flexural_rigidity_N_m2() * sum /
         (half_thickness_m * half_thickness_m * arm::total_inertia_kg_m2(arm));
}

}  // namespace flexarm::compare::paper
