#pragma once

#include <complex>
#include <vector>

namespace flexarm::report {

/// Principal value of the phase of each value [deg], in [-225, 135), so that the multiples of 90
/// deg of light damping never wrap; NaN where the value is 0 or NaN. What was measured has this
/// phase, and a model beside it; a model by itself has the continuous one
/// (response/frequency/continuous_phase.hpp). Neither depends on neighbours.
std::vector<double> principal_phase_deg(const std::vector<std::complex<double>>& response);

}  // namespace flexarm::report
