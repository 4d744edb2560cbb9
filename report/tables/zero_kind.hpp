#pragma once

#include "measured/modal/fitted_zeros.hpp"

#include <complex>
#include <numbers>
#include <optional>

namespace flexarm::report {

/// True for an undamped zero off the imaginary axis. It is listed once and stands for +-s, or for
/// +-s and the conjugates: one of them at least is in the right half plane, a non-minimum-phase
/// zero.
inline bool is_non_minimum_phase(std::complex<double> undamped_zero_rad_per_s) {
  return undamped_zero_rad_per_s.real() != 0.0;
}

/// Standard errors by which a measured zero must be in the right half plane.
inline constexpr double kSurelyRight = 2.0;

/// True for a measured zero whose damping ratio -Re s/|s| is negative by more than two standard
/// errors; without a standard error, for a negative one.
inline bool is_non_minimum_phase(std::optional<double> damping_ratio,
                                 std::optional<double> standard_error) {
  return damping_ratio && *damping_ratio + kSurelyRight * standard_error.value_or(0.0) < 0.0;
}

/// True for such a zero of a fit; a real one is judged by the standard error of its size.
inline bool is_non_minimum_phase(const measured::FittedZero& zero) {
  const double real_rad_per_s = zero.s_rad_per_s.real();
  if (zero.s_rad_per_s.imag() != 0.0) {
    return is_non_minimum_phase(zero.damping_ratio, zero.damping_ratio_std);
  }
  return real_rad_per_s > kSurelyRight * 2.0 * std::numbers::pi * zero.frequency_std_Hz;
}

}  // namespace flexarm::report
