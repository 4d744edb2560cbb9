#pragma once

#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::response {

inline const arm::Sensor kHubAngle{arm::SensorKind::hub_angle, 0.0};
inline const arm::Sensor kHubVelocity{arm::SensorKind::hub_velocity, 0.0};
inline const arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration, 0.0};
inline const arm::Sensor kTipDisplacement{arm::SensorKind::tip_displacement, 0.0};

/// Sensors hub angle and hub velocity, which `oscillator` and `two_masses` have.
inline std::vector<arm::Sensor> hub_sensors() {
  return {kHubAngle, kHubVelocity};
}

/// I theta'' + c theta' + k theta = T.
inline arm::ModalModel oscillator(double inertia, double stiffness, double damping = 0.0) {
  arm::ModalModel model;
  model.modal_mass_kg_m2 = inertia;
  model.modes = {{.omega_rad_per_s = stiffness > 0.0 ? std::sqrt(stiffness / inertia) : 0.0,
                  .hub_slope = 1.0,
                  .sensor_values = {1.0, 1.0},
                  .displacement_m = {}}};
  model.lowest_omega_squared_rad2_per_s2 = stiffness / inertia;
  model.damping_rad_per_s = {damping / inertia};
  return model;
}

/// A hub of inertia I and a flywheel of inertia J on a torsion spring k. In relative motion the
/// hub moves by -J, the wheel by I; scaled to the modal mass I + J.
inline arm::ModalModel two_masses(double hub, double wheel, double stiffness) {
  arm::ModalModel model;
  const double total = hub + wheel;
  model.modal_mass_kg_m2 = total;
  const double slope = std::sqrt(wheel / hub);
  model.modes = {
      {.omega_rad_per_s = 0.0, .hub_slope = 1.0, .sensor_values = {1.0, 1.0}, .displacement_m = {}},
      {.omega_rad_per_s = std::sqrt(stiffness * total / (hub * wheel)),
       .hub_slope = slope,
       .sensor_values = {slope, slope},
       .displacement_m = {}}};
  model.damping_rad_per_s.assign(4, 0.0);
  return model;
}

/// Gives the parts an effect outside of the linear arm.
inline void put(ArmParts& parts, std::string_view effect,
                const std::map<std::string, double>& parameters, const std::string& sensor = {}) {
  add_effect(parts, effects::effect(effect, parameters, sensor));
}

inline ArmParts coulomb(double torque_N_m) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  put(parts, "coulomb_friction", {{"torque", torque_N_m}});
  return parts;
}

/// `samples` of one torque.
inline std::vector<double> step_torque(double torque_N_m, std::size_t samples) {
  return std::vector<double>(samples, torque_N_m);
}

}  // namespace flexarm::response
