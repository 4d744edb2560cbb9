#pragma once

#include "measured/checks/data_check_kinematics.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Sensors that read something at rest, of a stretch that begins at rest: mean of reading less
/// described reading x - y over the first samples, weighted by 1/(n^2 + y^2) with n^2 the noise
/// floor. The weight falls as the described arm begins to move, of which nothing is known. Without
/// a described arm (DescribedStretch::values is empty) or a usable torque the first sample alone is
/// at rest, and the acceleration answers the torque at once.
std::vector<DataFinding> check_offsets(const Comparison& comparison,
                                       std::span<const std::vector<double>> described);

}  // namespace flexarm::measured
