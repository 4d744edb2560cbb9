#pragma once

#include "measured/files/measurement.hpp"
#include "measured/spectra/spectra.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace flexarm::measured {

/// Estimates of a frequency response from mean spectra, (44)-(46) of the paper, a value a line.
struct FrequencyResponseEstimators {
  /// S_xy/S_xx: least squares with the noise on the output. Without bias where the input has none,
  /// as a commanded torque.
  std::vector<std::complex<double>> h1;
  /// S_yy/S_yx: least squares with the noise on the input.
  std::vector<std::complex<double>> h2;
  /// Geometric mean: sqrt(S_yy/S_xx) with the phase of S_xy. It is the total least squares fit of
  /// signals each scaled to unit power, without bias where both have the same noise to signal.
  std::vector<std::complex<double>> hv;
  std::vector<double> coherence;  ///< gamma^2 = H1/H2, 0 to 1
};

/// From input to the `output`-th of `spectra`. Lines where the input or the output is 0 or unknown
/// are NaN.
FrequencyResponseEstimators estimate(const CrossSpectra& spectra, std::size_t output);

/// What random errors do to an estimate, to first order and where noise is normal and white across
/// the window's lines ([BendatPiersol2010], chapter 9). `averages` is nd.
///
///     std |H|/|H| = std arg H = sqrt((1 - gamma^2)/(2 nu gamma^2)),   nu = nd - 1,
///
/// for H1, H2 and Hv alike. Their nd is nu here: 1 - gamma^2 is estimated with H, which takes one
/// of the averages. NaN for nd <= 1. The second moment sqrt(E|dH|^2) is sqrt(2) times as large.
double relative_response_std(double coherence, double averages);

/// Radius, relative to |H1|, of the circle around H1 that holds H with that probability: the noise
/// that is left has 2 nu degrees of freedom,
///
///     r^2 = (1 - gamma^2)/gamma^2 ((1 - p)^(-1/nu) - 1)
///
/// ([Goodman1957]; the quantile of F(2, 2 nu) in closed form). Exact for segments that do not
/// overlap. Infinite for nd <= 1.
double relative_confidence_radius(double coherence, double averages, double probability);

/// E[estimated gamma^2] - gamma^2 = (1 - gamma^2)^2/nd (1 + 2 gamma^2/nd)
/// ([CarterKnappNuttall1973], to second order): 1 for a single segment whatever the signals.
double coherence_bias(double coherence, double averages);

/// sqrt(2) |gamma| (1 - gamma^2)/sqrt(nd), the standard deviation of estimated gamma^2.
double coherence_std(double coherence, double averages);

/// What the estimated coherence of unrelated signals exceeds with that probability:
/// 1 - probability^(1/(nd - 1)). 1 for nd <= 1.
double coherence_of_chance(double averages, double probability);

/// What a hold makes of samples, at f [Hz]: exp(-i pi f T) sinc(f T) of a torque that is constant
/// from sample to sample, sinc^2(f T) of one that is linear between them; sinc x = sin(pi x)/(pi
/// x).
///
/// The response of sampled readings to the torque's samples is, exactly,
///
///     G_d(f) = sum_m h(f + m fs) G(f + m fs),
///
/// with the arm's own response G. Divided by h(f) it is G(f) and the images that sampling folds
/// back, weighted as h(f + m fs)/h(f) = f/(f + m fs), for a linear torque squared:
///
///     G_d/h = G(f) + sum_{m != 0} (f/(f + m fs))^(1 or 2) G(f + m fs).
///
/// Where G falls as f^-q the images are some 2 (f/fs)^(q + 1) of it and more as f nears fs/2; they
/// cannot be taken off without a model. A reading that jumps with the torque (an acceleration under
/// a held torque) is taken in the sum at the middle of its jump.
std::complex<double> hold_response(TorqueHold hold, double frequency_Hz, double period_s);

}  // namespace flexarm::measured
