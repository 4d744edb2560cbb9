#pragma once

#include "measured/checks/data_check_kinematics.hpp"

#include <vector>

namespace flexarm::measured {

/// A torque that is recorded with an offset, or a constant torque that is not: by least squares
/// over the lowest lines of the hub's acceleration A,
///
///     A = a Y[tau] - b Y[1] - c Y[sign v] - d Y[v],
///
/// Y[.] what the described arm answers to a torque, v the hub's velocity as recorded: what friction
/// takes, dry and viscous, is estimated beside the offset b. For a stretch that begins at rest,
/// with hub_velocity or hub_angle. `arm` must be a described one.
std::vector<DataFinding> check_torque_offset(const Comparison& comparison, const DescribedArm& arm);

}  // namespace flexarm::measured
