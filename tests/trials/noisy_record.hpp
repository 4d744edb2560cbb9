#pragma once

#include "measured/files/time_record.hpp"
#include "tests/trials/random.hpp"
#include "tests/trials/time_simulation.hpp"

#include <span>

namespace flexarm::trials {

/// The record of a simulated run with white noise, whose standard deviation is `noise` times that
/// of each channel.
measured::TimeRecord noisy_record(SimulatedRun simulated, std::span<const arm::Sensor> sensors,
                                  double noise, Random& random);

}  // namespace flexarm::trials
