#pragma once

#include "response/any_formulation.hpp"

#include <functional>
#include <span>
#include <string_view>
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

/// Called with what is done next and the fraction of the work done; false ends it, with what there
/// is until then.
using SummaryProgress = std::function<bool(std::string_view what, double fraction)>;

/// `count` poles, modes and zeros each. Throws InputError for a sensor that the arm cannot carry.
ModalSummary summarise(const AnyFormulation& formulation, int count,
                       std::span<const arm::Sensor> sensors, std::span<const double> stations_m,
                       const SummaryProgress& tell = {});

/// lambda = sqrt(omega/omega_scale), the root of the frequency equation.
double lambda_of(const arm::Arm& arm, double omega_rad_per_s);

}  // namespace flexarm::response
