#pragma once

#include <complex>
#include <optional>

namespace flexarm::report {

/// True for an undamped zero off the imaginary axis. It is listed once and stands for +-s, or for
/// +-s and the conjugates: one of them at least is in the right half plane, a non-minimum-phase
/// zero.
inline bool is_non_minimum_phase(std::complex<double> undamped_zero_rad_per_s) {
  return undamped_zero_rad_per_s.real() != 0.0;
}

/// True for a measured zero whose damping ratio -Re s/|s| is negative by more than two standard
/// errors; without a standard error, for a negative one.
inline bool is_non_minimum_phase(std::optional<double> damping_ratio,
                                 std::optional<double> standard_error) {
  return damping_ratio && *damping_ratio + 2.0 * standard_error.value_or(0.0) < 0.0;
}

}  // namespace flexarm::report
