#pragma once

#include "measured/files/time_record.hpp"

#include <cstddef>

namespace flexarm::measured {

/// The sample from which all channels of a record are in free motion: behind the first of 50
/// windows in which each moves at least half as much as in any, 0 where it moves before that. The
/// hub, which may turn freely, says nothing of it. 0 of a record without kLeastSamples samples from
/// there.
std::size_t begin_of_decay(const TimeRecord& record);

}  // namespace flexarm::measured
