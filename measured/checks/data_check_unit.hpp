#pragma once

#include "measured/checks/data_check_kinematics.hpp"

#include <vector>

namespace flexarm::measured {

/// A channel off by a power of ten, degrees for radians and the like, or by another factor
/// (Fault::wrong_scale): gains that physics lays down between channels and that one scale of one
/// channel explains.
///
/// - exact: hub_velocity over d/dt hub_angle, tip_acceleration over d^2/dt^2 tip_displacement,
///   tip_displacement over tip_deflection beside hub_angle: 1;
/// - with the arm's length, at frequencies far below the first clamped one: tip motion over hub
///   motion, roughly the length;
/// - with the total inertia, there: torque over hub acceleration, roughly the inertia;
/// - with the described arm: any two signals as it reads them for the same torque;
/// - a strain that no link survives.
///
/// A scale that is no unit is read from the exact relations and from those of the described arm.
std::vector<DataFinding> check_units(const Comparison& comparison);

}  // namespace flexarm::measured
