#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Times that run too fast or too slow by a factor, the finding's value: recorded period over true
/// one. Torque and readings of each sample are as they were, so the described arm answers that
/// torque as the record shows at the true period alone. Factors tried are 2, 4, 10 and their
/// inverses, and the gain of hub_velocity over d/dt hub_angle, which is the factor where the arm
/// tells both rightly. Empty where no arm is described, or where it fits as recorded.
///
/// `usable` says which signals may be asked; the first is the torque.
std::vector<DataFinding> check_clock_rate(std::span<const CheckedSignal> signals,
                                          const std::vector<bool>& usable, double period_s,
                                          bool from_rest, const DataCheckOptions& options);

}  // namespace flexarm::measured
