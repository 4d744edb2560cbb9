#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// The first samples behind a change of the sampling period: each begins a block of another period
/// than the block before. None where the steps do not fall into such blocks: blocks of 10 samples
/// or more hold nine tenths of the samples, and four fifths of the steps of each are within 10 %
/// (25 % for an uneven clock) of their median. A pause, a late sample, a burst after a stall and a
/// clock that drifts are no change. Times are increasing.
std::vector<std::size_t> period_changes(std::span<const double> times_s);

}  // namespace flexarm::measured
