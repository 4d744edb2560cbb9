#pragma once

#include "measured/checks/data_check_signal.hpp"

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// Transforms of one channel x(t) under a window w that vanishes with w' and w'' at both ends:
///
///     T_w(omega) = sum_k w(t_k) x(t_k) exp(-i omega t_k).
///
/// With those under w' and w'' the transforms of the derivatives follow by parts, without leakage
/// from the ends and without differences of noisy values:
///
///     T_w[x'] = i omega T_w[x] - T_w'[x],
///     T_w[x''] = -omega^2 T_w[x] - 2 i omega T_w'[x] + T_w''[x].
struct Transform {
  std::vector<std::complex<double>> plain;   ///< one a bin, from 0
  std::vector<std::complex<double>> first;   ///< under w' [1/s]
  std::vector<std::complex<double>> second;  ///< under w'' [1/s^2]
  double floor_power = 0.0;  ///< of white noise as low as the lowest sixteenth of the spectrum
};

/// The transforms of all channels, on the same bins.
struct Transforms {
  double period_s = 0.0;
  double duration_s = 0.0;
  double spacing_rad_per_s = 0.0;  ///< of the bins, which padding makes closer than 1/duration
  double bins_per_line = 1.0;      ///< bins in 1/duration
  bool from_rest = false;          ///< rest was put in front
  double window_power = 0.0;       ///< sum of w^2
  std::vector<Transform> of;       ///< one a signal

  double omega_rad_per_s(std::size_t bin) const {
    return spacing_rad_per_s * static_cast<double>(bin);
  }
  std::size_t bin_at(double frequency_Hz) const;
  std::size_t bins() const { return of.front().plain.size(); }
  /// T_w of the derivative of that order, 0 to 2, of a signal.
  std::complex<double> derivative(std::size_t signal, int order, std::size_t bin) const;
  /// Power of its white noise in a bin.
  double noise_power(std::size_t signal, int order, std::size_t bin) const;
};

/// `signals` of one length, 16 values or more, a period apart. `from_rest`: the arm rested before
/// the first sample; a tenth of the record is then put in front at each sensor's reading at rest,
/// so that the window leaves the start whole.
Transforms transform(std::span<const CheckedSignal> signals, double period_s, bool from_rest);

}  // namespace flexarm::measured
