#pragma once

#include <complex>
#include <vector>

namespace flexarm::report {

enum class Phase {
  wrapped,    ///< in [-225, 135) deg, so that the multiples of 90 deg of light damping never wrap
  unwrapped,  ///< the first as wrapped, then with the smaller of the two turns to the next value
};

/// Phase of each value [deg], those of ascending frequencies; NaN where the value is 0 or NaN.
///
/// Unwrapped, a turn of 170 to 190 deg may go either way, and one of 180 deg is all that an
/// undamped response ever makes. It goes down at a pole, which the magnitude rises to and falls
/// from, and up at a zero; where the magnitude says neither, an exact half turn goes towards -90
/// deg.
std::vector<double> phase_deg(const std::vector<std::complex<double>>& response, Phase phase);

}  // namespace flexarm::report
