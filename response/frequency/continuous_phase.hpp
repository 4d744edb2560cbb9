#pragma once

#include "response/frequency/transfer_forms.hpp"
#include "response/linear_chain.hpp"

#include <complex>
#include <span>
#include <vector>

namespace flexarm::response {

/// What gives a value of a frequency response its phase without its neighbours.
///
/// The phase is the one of the value's angles arg G + 360 deg k that is nearest to that of the
/// product over poles and zeros,
///
///     90 deg power - 180 deg (gain < 0)
///         + sum_z arg(1 - u/z^2) - sum_p arg(1 + u/omega_p^2)
///         - 360 deg f delay - sum_lags atan(omega lag),
///     u = s^2/(1 + kv s),  s = i omega,
///
/// so that it is continuous in frequency, counted from s -> 0: a lightly damped pole turns it by
/// -180 deg, a zero near the imaginary axis by +180 deg, a pair of real zeros +-z by nothing. With
/// Kelvin-Voigt damping alone the product is exact, for inertia enters as s^2/(1 + kv s). Other
/// dampings move it by less than the half turn that is needed to choose the wrong k, unless they
/// overdamp several modes.
struct PhaseReference {
  double initial_deg = 0.0;
  std::vector<double> omega_rad_per_s;  ///< undamped poles, the lowest of a restrained hub too
  std::vector<std::complex<double>> zeros_rad_per_s;  ///< as in ZeroSet
  double kelvin_voigt_s = 0.0;
  double delay_s = 0.0;
  std::vector<double> lags_s;

  /// Of the product at a frequency.
  double phase_deg(double frequency_Hz) const;
};

/// `product` has all poles and zeros below the highest frequency that is asked for.
PhaseReference phase_reference(const ProductFactors& product, const LinearChain& chain,
                               double kelvin_voigt_s);

/// Phase of each value [deg]; NaN where the value is 0 or not finite.
std::vector<double> continuous_phase_deg(const PhaseReference& reference,
                                         std::span<const double> frequency_Hz,
                                         std::span<const std::complex<double>> values);

}  // namespace flexarm::response
