#pragma once

#include "measured/data_check.hpp"
#include "measured/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Slow trends over the record that nothing else accounts for:
///
/// - hub_angle less the integral of hub_velocity, the mean of the last tenth less that of the
///   first;
/// - in tip_acceleration, tip_deflection and strain, which at frequencies far below the first mode
///   are proportional to what turns the arm, a ramp beside offset and torque: least squares over
///   the lines 0 to 4/duration under Hann's window, which keeps the modes out.
///
/// `floor_power` as for `check_quantisation`; `usable` says which signals may be judged.
std::vector<DataFinding> check_drift(std::span<const Signal> signals,
                                     const std::vector<bool>& usable,
                                     std::span<const double> floor_power, double period_s,
                                     const DataCheckOptions& options);

}  // namespace flexarm::measured
