#pragma once

#include "measured/spectra/spectra.hpp"

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// A periodic signal at its lines, frequency k/(period), k = 1, 2, ...
struct PeriodicSignal {
  /// Complex amplitude of exp(+2 pi i f t) times two: its size is that of the sine. t = 0 at the
  /// first sample used. In the signal's unit, differences taken back.
  std::vector<std::complex<double>> amplitude;
  std::vector<double> noise_std;  ///< sqrt(E|d amplitude|^2); NaN for one period
  /// What rounding of the samples may leave of an amplitude that is 0.
  std::vector<double> rounding;
};

/// Periodic input and outputs at their lines, with what varies from period to period.
///
/// All periods used are transformed at once. Of P periods the signal stands on every P-th line of
/// that transform, k P; the P - 1 lines between hold what does not repeat: noise, and the
/// transient, which is smooth from line to line. A polynomial of degree 0 for P = 2, 1 for P = 3, 2
/// for more, fitted to the 2 (P - 1) lines around k P, is taken off there, and its residuals are
/// the noise (the local polynomial method [PintelonSchoukens2012]).
/// So the response is that of the steady state, exact at the lines but for noise, before the
/// transient has died; and noise of lines of one parity is independent.
struct PeriodicSpectra {
  std::vector<double> frequency_Hz;
  std::size_t period_samples = 0;
  std::size_t periods = 0;          ///< P, those used
  double degrees_of_freedom = 0.0;  ///< nu, complex ones, of each noise variance; 0 for one period
  PeriodicSignal input;
  std::vector<PeriodicSignal> outputs;
  /// E[conj(d a) d b] of the amplitudes at each line; index 0 is the input, 1 + i output i. Empty
  /// for one period.
  std::vector<Eigen::MatrixXcd> noise_covariance;
};

/// Of the last `periods` periods of signals sampled `period_s` apart. Of an even number of samples
/// a period, line n/2 is left out. Work is that of one transform of all samples a signal; memory is that of a
/// transform a signal.
///
/// Throws InputError for a record that is shorter, a period of fewer than 4 samples, no period.
PeriodicSpectra periodic_spectra(const Signal& input, std::span<const Signal> outputs,
                                 double period_s, std::size_t period_samples, std::size_t periods);

/// How many of `periods` periods at the end to leave out at their beginning, because the outputs
/// have not settled: a period is left out while it differs from the next by more than four times
/// (in mean square, differences taken as the signals say) what is usual in the later half. At least
/// half of the periods, and two, stay.
std::size_t unsettled_periods(std::span<const Signal> outputs, std::size_t period_samples,
                              std::size_t periods);

/// Whether a line is driven: its amplitude is more than 1e-3 of the largest line's, and, where
/// noise is known, significant at 1e-4.
std::vector<bool> driven_lines(const PeriodicSpectra& spectra);

/// The probability of a line's amplitude, or a larger one, where there is noise alone:
/// (1 + |amplitude|^2/(nu noise_std^2))^-nu, F(2, 2 nu). Noise that rounding may hide in is taken
/// as that large. NaN for one period.
double probability_of_chance(const PeriodicSignal& signal, std::size_t line,
                             double degrees_of_freedom);

}  // namespace flexarm::measured
