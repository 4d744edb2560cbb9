#include "assumed_modes/output_row.hpp"

#include <stdexcept>

namespace flexarm::assumed_modes {

OutputRow output_row(const arm::Sensor& sensor, const arm::LinearArm& arm,
                     const AdmissibleFunctions& functions) {
  const Real length = arm.length_m;
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return {1, functions.motor_rotation()};
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
      return {length, functions.displacement(1)};
    case arm::SensorKind::tip_deflection: {
      const Vector tip = functions.displacement(1);
      OutputRow deflection{length, tip - tip(0) * functions.hub_rotation()};
      deflection.row(0) = 0;
      return deflection;
    }
    case arm::SensorKind::strain:
      return {static_cast<Real>(arm.thickness_m.value()) / (2 * length),
              functions.curvature(sensor.position_m / length)};
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

}  // namespace flexarm::assumed_modes
