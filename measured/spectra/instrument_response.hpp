#pragma once

#include "measured/spectra/spectra.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace flexarm::measured {

/// A response y/x of two noisy numbers a line: spectra with an instrument, or mean amplitudes.
struct NoisyRatio {
  std::vector<std::complex<double>> x;
  std::vector<std::complex<double>> y;
  std::vector<double> x_variance;                ///< E|dx|^2
  std::vector<double> y_variance;                ///< E|dy|^2
  std::vector<std::complex<double>> covariance;  ///< E[conj(dx) dy]

  /// sqrt(E|d(y/x)|^2) at a line, to first order.
  double deviation(std::size_t line) const;
  /// The same where the ratio is known to be g: with x0, the likeliest x for y = g x, in place of
  /// x. Weights need this one: in the other, noise of x that makes y/x small makes it small too.
  double deviation(std::size_t line, std::complex<double> g) const;
};

/// x = S_zx and y = S_zy from mean spectra of segments: `of_input` from the input to the outputs,
/// `of_instrument` from the instrument z to the input, its first output, and to the same outputs.
/// What z does not explain of the signals is their noise; of nu = nd - 1,
///
///     E[conj(dx) dy] = S_zz (S_xy - conj(S_zx) S_zy/S_zz)/nu.
NoisyRatio instrument_ratio(const CrossSpectra& of_input, const CrossSpectra& of_instrument,
                            std::size_t output);

/// sqrt(E|d S_zx|^2)/|S_zx| of each line: sqrt((1 - gamma_zx^2)/(nu gamma_zx^2)). H is a ratio:
/// where this is not small, it is neither normal nor free of bias.
std::vector<double> instrument_relative_std(const CrossSpectra& of_instrument);

}  // namespace flexarm::measured
