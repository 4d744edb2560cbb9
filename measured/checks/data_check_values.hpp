#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Faults that a channel shows by its own values: constant, clipped, stuck. At most one a channel,
/// that which comes first here. `signals` are the torque and all channels, over the whole record.
///
/// Rest is none of them: a value that the channel reaches and leaves ever more slowly, a velocity
/// of exactly zero, the same value in every channel.
std::vector<DataFinding> check_values(std::span<const CheckedSignal> signals,
                                      const DataCheckOptions& options);

/// Whether a torque is made of pulses or steps: fewer than 20 values.
bool has_few_levels(std::span<const double> torque);

/// Whether a run of equal values is entered and left as a hub comes to rest and leaves it: with
/// changes that fade like 1/2, 3/2, 5/2 of one size. The ends of the record say nothing against it.
/// `rounding`: the step in which values are written, by which a change may be off.
bool is_restful(std::span<const double> values, const EqualRun& run, double rounding = 0.0);

/// A coarse step. `floor_power` has for each signal the power, in its unit squared, of white noise
/// as low as the lowest part of its spectrum.
std::vector<DataFinding> check_quantisation(std::span<const CheckedSignal> signals,
                                            std::span<const double> floor_power,
                                            const DataCheckOptions& options);

}  // namespace flexarm::measured
