#pragma once

#include "tests/measured/data_check_cases.hpp"

namespace flexarm::measured {

Channel& any_channel(TimeRecord& record, response::RandomNumbers& random);

/// A record of a run as what a fault is planted in.
PlantedFault planted(const DrawnRun& run, TimeRecord record);

/// Names the channel that the fault is in.
void in(PlantedFault& result, const Channel& channel);

// Of the clock and the sampling.
PlantedFault clock_jitter(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault missing_samples(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault backward_time(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault duplicated_samples(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault sampling_jitter(std::uint64_t seed, response::RandomNumbers& random);

// Of what is added to a signal.
PlantedFault spikes(std::uint64_t seed, response::RandomNumbers& random);
PlantedFault hum(std::uint64_t seed, response::RandomNumbers& random);

}  // namespace flexarm::measured
