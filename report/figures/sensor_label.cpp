#include "report/figures/sensor_label.hpp"

#include <fmt/format.h>

namespace flexarm::report {

std::string sensor_label(const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
      return "hub angle";
    case arm::SensorKind::hub_velocity:
      return "hub velocity";
    case arm::SensorKind::tip_acceleration:
      return "tip acceleration";
    case arm::SensorKind::tip_displacement:
      return "tip displacement";
    case arm::SensorKind::tip_deflection:
      return "tip deflection";
    case arm::SensorKind::strain:
      break;
  }
  return fmt::format("strain at {} m", sensor.position_m);
}

std::string axis_unit(const arm::Sensor& sensor) {
  const auto unit = arm::unit(sensor);
  return unit == "1" ? "" : std::string(unit);
}

}  // namespace flexarm::report
