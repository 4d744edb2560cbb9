#pragma once

#include "response/any_formulation.hpp"

#include <span>
#include <vector>

namespace flexarm::response {

/// The zeros of torque to one sensor.
struct SensorZeros {
  arm::Sensor sensor;
  arm::ZeroSet zeros;
};

/// What one formulation says of an arm: poles, modes, and the zeros of the sensors asked for.
struct ModalSummary {
  arm::PoleSet poles;
  arm::DampedPoleSet damped_poles;
  std::vector<arm::Sensor> sensors;
  std::vector<arm::Mode> modes;    ///< sensor values in the order of `sensors`
  std::vector<double> stations_m;  ///< where the modes' displacements are
  std::vector<SensorZeros> zeros;  ///< one a sensor
};

/// `count` poles, modes and zeros each. Throws InputError for a sensor that the arm cannot carry.
ModalSummary summarise(const AnyFormulation& formulation, int count,
                       std::span<const arm::Sensor> sensors, std::span<const double> stations_m);

/// lambda = sqrt(omega/omega_scale), the root of the frequency equation.
double lambda_of(const arm::Arm& arm, double omega_rad_per_s);

}  // namespace flexarm::response
