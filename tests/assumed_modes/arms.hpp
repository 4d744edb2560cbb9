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

/// The arm's numbers are rounded to double, 1e-16 each, as are omega and a ratio of two; omega^2
/// twice.
inline constexpr double kRounding = 4e-15;
/// Zeros away from the hub: each next one is 40 times worse conditioned (a motion that dies out
/// from tip to hub is to be told from zero); the sixth is left with 1e-9 of 64 bits.
inline constexpr double kTipZeroRounding = 1e-9;
/// A dense solve in double of a matrix whose condition number is near 1e4.
inline constexpr double kDirectSolve = 1e-10;

/// The setting of the program's commands for up to ten roots.
inline constexpr int kDefault = 40;

inline constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle, 0.0};
inline constexpr arm::Sensor kHubVelocity{arm::SensorKind::hub_velocity, 0.0};
inline constexpr arm::Sensor kTipAcceleration{arm::SensorKind::tip_acceleration, 0.0};
inline constexpr arm::Sensor kTipDisplacement{arm::SensorKind::tip_displacement, 0.0};
inline constexpr arm::Sensor kTipDeflection{arm::SensorKind::tip_deflection, 0.0};

constexpr arm::Sensor strain_at(double position_m) {
  return {arm::SensorKind::strain, position_m};
}

}  // namespace flexarm::assumed_modes::testing_arms
