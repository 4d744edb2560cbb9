#pragma once

#include "arm/sensor.hpp"

#include <limits>

namespace flexarm::fem {

inline constexpr arm::Sensor kHubAngle{arm::SensorKind::hub_angle};
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace flexarm::fem
