#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"

namespace flexarm::assumed_modes::testing_arms {

/// EI = m = l = 1, so that inertias are the ratios epsilon, eta, iota and omega = lambda^2.
inline arm::Arm unit_arm(double hub_inertia, double payload_mass, double payload_inertia) {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.beam.thickness_m = 0.01;
  arm.hub.inertia_kg_m2 = hub_inertia;
  arm.payload = {payload_mass, payload_inertia};
  return arm;
}

inline constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle, 0.0};
inline constexpr arm::Sensor kHubVelocity{arm::SensorKind::hub_velocity, 0.0};
inline constexpr arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration, 0.0};
inline constexpr arm::Sensor kTipDisplacement{arm::SensorKind::tip_displacement, 0.0};
inline constexpr arm::Sensor kTipDeflection{arm::SensorKind::tip_deflection, 0.0};

constexpr arm::Sensor strain_at(double position_m) {
  return {arm::SensorKind::strain, position_m};
}

}  // namespace flexarm::assumed_modes::testing_arms
