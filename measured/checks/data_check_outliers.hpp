#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Single samples that neither their neighbours in time nor the other channels account for.
///
/// Each channel is predicted, by least squares over the record, from its own three samples before
/// and after, the torque up to two samples off and every other channel up to one sample off. For a
/// linear arm that leaves noise, also where the torque jumps; the residual's robust deviation is
/// the measure. The first and last three samples are predicted from one side. The worst sample is
/// repaired before the next is judged, so that a spike in one channel is not found in another that
/// it helps to predict. Findings hold what the record, with every spike repaired, predicts in their
/// places.
///
/// `signals[0]` is the torque, which is not searched; `usable` says which others are. Without
/// `ends_are_sound` the first and last three samples are not searched: their times may be wrong.
std::vector<DataFinding> check_spikes(std::span<const CheckedSignal> signals,
                                      const std::vector<bool>& usable,
                                      const DataCheckOptions& options, bool ends_are_sound);

}  // namespace flexarm::measured
