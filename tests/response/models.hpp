#pragma once

#include "arm/linear_arm.hpp"
#include "response/any_formulation.hpp"
#include "response/formulation_maker.hpp"

#include <vector>

namespace flexarm::response {

inline constexpr const char* kFormulations[] = {"exact_tf", "fem", "assumed_modes"};

inline const std::vector<arm::Sensor>& every_sensor() {
  static const std::vector<arm::Sensor> sensors = {
      {arm::SensorKind::hub_angle},        {arm::SensorKind::hub_velocity},
      {arm::SensorKind::tip_acceleration}, {arm::SensorKind::tip_displacement},
      {arm::SensorKind::tip_deflection},   {arm::SensorKind::strain, 0.05}};
  return sensors;
}

/// The paper's arm with a payload, Kelvin-Voigt damping and hub friction.
inline arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.payload.mass_kg = 0.03;
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  return arm;
}

}  // namespace flexarm::response
