#pragma once

#include "arm/sensor.hpp"

#include <string>

namespace flexarm::report {

/// What stands beside a panel of a sensor: "tip acceleration", "strain at 0.05 m".
std::string sensor_label(const arm::Sensor& sensor);

/// Its unit as an axis shows it; empty where it has none.
std::string axis_unit(const arm::Sensor& sensor);

}  // namespace flexarm::report
