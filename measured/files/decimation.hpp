#pragma once

#include "measured/files/time_record.hpp"

#include <cstddef>
#include <vector>

namespace flexarm::measured {

/// The low-pass before decimation by `factor`: a symmetric FIR of odd length, a sinc behind a
/// Kaiser window [OppenheimSchafer2010]. With the Nyquist frequency f after decimation its gain is
/// 1 within 1e-4 up to 0.8 f, and below 1e-4 from f on, so that nothing aliases. Its sum is 1.
std::vector<double> decimation_filter(std::size_t factor);

/// The samples that a record needs to be decimated.
std::size_t fewest_samples(std::size_t factor);

/// Every `factor`-th sample of the filtered record. All signals, the torque included, go through
/// the same filter, which has zero phase: what is linear between torque and sensors is unchanged.
/// Half a filter length is lost at both ends, where samples of the record would have to be made up.
///
/// A filtered torque is no longer constant between samples: it is band-limited, and nearly linear
/// from sample to sample (first-order hold). An arm that was at rest at the first sample need not
/// be at the first one of the result. A reference is left out: no controller makes a filtered
/// torque of it. No sample of the result is left out (Channel::left_out): the values in the place
/// of readings that are none have about 1/factor of the weight of a sample.
///
/// `factor` is 2 or more. Throws InputError for a record of fewer than `fewest_samples`.
TimeRecord decimated(const TimeRecord& record, std::size_t factor);

}  // namespace flexarm::measured
