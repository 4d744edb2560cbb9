#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Slow trends in tip_acceleration, tip_deflection and strain. At frequencies far below the first
/// mode they are proportional to what turns the arm: a ramp beside an offset and the torque is
/// sought, by least squares over the lines 0 to 4/duration under Hann's window, which keeps the
/// modes out. `usable` says which signals may be judged; the first is the torque.
std::vector<DataFinding> check_trends(std::span<const CheckedSignal> signals,
                                      const std::vector<bool>& usable,
                                      const DataCheckOptions& options);

/// Drift of hub_angle less the integral of hub_velocity: the mean of the last tenth less that of
/// the first. `floor_power` as for `check_quantisation`.
std::vector<DataFinding> check_angle_drift(std::span<const CheckedSignal> signals,
                                           const std::vector<bool>& usable,
                                           std::span<const double> floor_power, double period_s,
                                           const DataCheckOptions& options);

}  // namespace flexarm::measured
