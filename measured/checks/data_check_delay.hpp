#pragma once

#include "measured/checks/data_check_kinematics.hpp"

#include <vector>

namespace flexarm::measured {

/// The sensor that is later than the others, if one is: by the slope of the phase of
///
/// - hub_velocity over d/dt hub_angle;
/// - with the described arm: any two sensors over what it reads of them for the same torque.
///
/// The torque is not asked: what lies between it and all sensors is the drive's.
std::vector<DataFinding> check_delay(const Comparison& comparison);

}  // namespace flexarm::measured
