#pragma once

#include "measured/checks/data_check_kinematics.hpp"

#include <vector>

namespace flexarm::measured {

/// Channels that nothing else knows of: noise or hum that is coherent with neither the torque nor
/// any other sensor; and a torque that is white noise coherent with no sensor.
std::vector<DataFinding> check_response(const Comparison& comparison);

}  // namespace flexarm::measured
