#pragma once

#include "measured/checks/data_check_kinematics.hpp"

#include <vector>

namespace flexarm::measured {

/// Channels of the wrong sign: those that are out of step with the signs that physics lays down for
/// any pair, when as few channels as possible are taken to be wrong.
///
/// - hub_velocity and d/dt hub_angle, tip_acceleration and d^2/dt^2 tip_displacement: alike;
/// - tip_displacement = (hub radius + length) hub_angle + tip_deflection: both alike;
/// - at frequencies far below the first clamped one the arm moves as if rigid: the tip accelerates
///   with the hub; inertia bends it back, so that deflection and strain oppose that acceleration;
/// - torque and hub velocity: an arm that starts at rest has taken up energy at every later
///   instant, int tau theta' dt >= 0, whatever its friction;
/// - with the described arm: any two signals as it reads them for the same torque.
std::vector<DataFinding> check_signs(const Comparison& comparison);

}  // namespace flexarm::measured
