#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Single samples of the torque that the motor never gave. A sample is predicted from eight of the
/// torque before and after and from the channels two samples around. It is a spike if it deviates
/// as `DataCheckOptions` has it for channels, if the torque goes there and back in one sample, and
/// if no other residual within twelve samples is 0.4 of it.
///
/// Torque that the channels answer is real, and so is one that consists of pulses: spikes take less
/// than 0.9 of its power.
std::vector<DataFinding> check_torque_spikes(std::span<const CheckedSignal> signals,
                                             const std::vector<bool>& usable,
                                             const DataCheckOptions& options);

}  // namespace flexarm::measured
