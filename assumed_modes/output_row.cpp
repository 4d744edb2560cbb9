#include "assumed_modes/output_row.hpp"

#include <stdexcept>

namespace flexarm::assumed_modes {

Vector OutputRow::without_rigid_mode(const MassMatrix& mass) const {
  return flexible - rigid * mass.coupling / mass.rigid;
}

OutputRow output_row(const arm::Sensor& sensor, const arm::Arm& arm,
                     const AdmissibleFunctions& functions) {
  arm::require_valid(sensor, arm);
  const Real length = arm.beam.length_m;
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return {1, 1, functions.values(0, 1)};
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
      return {length, 1, functions.values(1, 0)};
    case arm::SensorKind::tip_deflection:
      return {length, 0, functions.values(1, 0) - functions.values(0, 1)};
    case arm::SensorKind::strain:
      return {static_cast<Real>(arm.beam.thickness_m.value()) / (2 * length), 0,
              functions.values(sensor.position_m / length, 2)};
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

}  // namespace flexarm::assumed_modes
