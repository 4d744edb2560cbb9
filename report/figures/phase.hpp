#pragma once

#include <complex>
#include <vector>

namespace flexarm::report {

/// Principal value of the phase of each value [deg], in [-225, 135), so that the multiples of 90
/// deg of light damping never wrap; NaN where the value is 0 or NaN.
std::vector<double> principal_phase_deg(const std::vector<std::complex<double>>& response);

/// Phase of each value [deg] without wraps, so that no resonance is broken: of the angles
/// arg G + 360 deg k the one nearest to the last value that has a phase. The first value has its
/// principal one, and so has a value half a turn from the last one, as beyond an undamped root. NaN
/// where the value is 0 or NaN.
std::vector<double> continuous_phase_deg(const std::vector<std::complex<double>>& response);

/// A phase over frequency, NaN where there is none.
struct PhaseCurve {
  std::vector<double> frequency_Hz = {};  ///< ascending
  std::vector<double> phase_deg = {};
};

/// Whole turns [deg] that bring the first of these phases to its principal value; 0 without one.
double to_principal_turn_deg(const std::vector<double>& phase_deg);

/// Turns each piece of a curve between gaps by whole turns, so that the median of its distances
/// from the reference is less than half a turn. Where it runs away from the reference, as where one
/// of them has a zero to the left of the imaginary axis and the other to the right, it goes on a
/// turn nearer, behind a gap of one value. A piece beyond the reference stays.
void turn_towards(const PhaseCurve& reference, PhaseCurve& curve);

}  // namespace flexarm::report
