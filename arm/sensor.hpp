#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::arm {

struct Arm;

enum class SensorKind {
  hub_angle,         ///< theta = y'(0) [rad]
  hub_velocity,      ///< d/dt theta [rad/s]
  tip_acceleration,  ///< d^2/dt^2 y(l) [m/s^2]
  tip_displacement,  ///< y(l) [m]
  tip_deflection,    ///< y(l) - l theta [m]
  strain,            ///< surface strain thickness/2 y''(X) [1]
};

/// What is measured, and for strain at which distance from the motor axis.
struct Sensor {
  SensorKind kind = SensorKind::hub_angle;
  double position_m = 0.0;  ///< X, strain only

  bool operator==(const Sensor&) const = default;
};

/// Reads a sensor's name as in docs/formats.md: `hub_angle`, `strain@0.05`. Throws InputError with
/// the names allowed, and the one that was probably meant.
Sensor parse_sensor(std::string_view name);

/// The name that `parse_sensor` reads.
std::string to_string(const Sensor& sensor);

/// Unit of the response, as in the measurement files: "rad", "m/s^2", "1".
std::string_view unit(const Sensor& sensor);

/// How many time derivatives of a displacement the sensor shows: 0, 1 or 2.
int derivative_order(const Sensor& sensor);

/// Torque and sensor act at the same place (hub angle, hub velocity), so that zeros interlace with
/// poles on the imaginary axis.
bool is_collocated(const Sensor& sensor);

/// The sensor at its place on the arm with the numbers that effects change (Port::arm_number).
/// Strain at the tip of the file's beam is at the tip of the changed one; any other place keeps its
/// distance from the root. From there effects move the gauge (Port::sensor_place). Throws
/// InputError as `require_valid`.
Sensor placed(const Sensor& sensor, const Arm& arm);
std::vector<Sensor> placed(std::span<const Sensor> sensors, const Arm& arm);

/// Throws InputError when the arm cannot carry the sensor: strain outside [0, l], where l is the
/// length with the arm's effects, or without a thickness.
void require_valid(const Sensor& sensor, const Arm& arm);

/// False for strain at the tip of an arm without payload inertia: the bending moment there is zero
/// at every s, so that no s is a zero more than another.
bool is_responsive(const Sensor& sensor, const Arm& arm);

/// Throws InputError unless the sensor `is_responsive`.
void require_responsive(const Sensor& sensor, const Arm& arm);

}  // namespace flexarm::arm
