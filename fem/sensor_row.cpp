#include "fem/sensor_row.hpp"

#include <stdexcept>

namespace flexarm::fem {

SensorRow sensor_row(const Discretisation& discretisation, const arm::LinearArm& arm,
                     const arm::Sensor& sensor) {
  SensorRow row;
  row.c = Eigen::VectorXd::Zero(discretisation.size());
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      row.c[0] = 1.0;
      break;
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
      row.c[discretisation.tip_deflection_index()] = 1.0;
      break;
    case arm::SensorKind::tip_deflection:
      row.c = discretisation.mass() * discretisation.tip_force_shape();
      row.by_inertia = true;
      row.infinite_roots = 3;
      break;
    case arm::SensorKind::strain:
      row.c = discretisation.ramp_momentum(sensor.position_m / arm.length_m);
      row.by_inertia = true;
      break;
  }
  return row;
}

double si_reading(const arm::LinearArm& arm, const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return 1.0;
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_deflection:
      return arm.length_m;
    case arm::SensorKind::strain:
      return *arm.thickness_m / (2.0 * arm.length_m);
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

}  // namespace flexarm::fem
