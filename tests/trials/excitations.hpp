#pragma once

#include "tests/trials/random.hpp"

#include <vector>

namespace flexarm::trials {

inline constexpr int kSamples = 4000;
inline constexpr double kSampleTime_s = 2e-3;

/// Normal noise of the lines k/duration from 0.5 to 60 Hz.
std::vector<double> random_torque(double rms_N_m, Random& random);
/// Odd lines from 0.9 to 80 Hz with random phases.
std::vector<double> multisine_torque(double rms_N_m, Random& random);
/// Rest, a pulse, its opposite, rest.
std::vector<double> bang_bang_torque(double amplitude_N_m);

}  // namespace flexarm::trials
