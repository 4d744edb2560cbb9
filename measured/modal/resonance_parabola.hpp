#pragma once

#include "measured/files/modal_table.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace flexarm::measured {

/// Place and width of a peak of power (of a valley) as one mode makes it: 1/power (power) is
///
///     y = c ((f^2 - place^2)^2 + (2 place half_width)^2),
///
/// for |G|^-2 of one mode is |omega_n^2 - omega^2 + 2 i zeta omega_n omega|^2: exact for a
/// displacement, with place^2 = f_n^2 (1 - 2 zeta^2).
struct ResonanceParabola {
  double place_Hz = 0.0;
  double place_std_Hz = 0.0;
  double half_width_Hz = 0.0;  ///< half the width between half-power points, of double power
  double half_width_std_Hz = 0.0;
  std::size_t lines = 0;
};

/// Weighted least squares through the lines within half a width of the place, three at least, found
/// from those within a factor of 4, or 16, of line `peak`; through three at the peak where those
/// make no parabola that opens upwards with its place among them. Empty where these do not either.
/// `relative_std` is each
/// power's standard deviation relative to itself; standard errors take the scatter about the
/// parabola where that is larger, times sqrt(`shared_variance`) for lines that are not independent
/// (`shared_line_variance` of measured/spectra/window.hpp).
std::optional<ResonanceParabola> resonance_parabola(std::span<const double> frequency_Hz,
                                                    std::span<const double> power,
                                                    std::span<const double> relative_std,
                                                    Feature feature, std::size_t peak,
                                                    double shared_variance = 1.0);

}  // namespace flexarm::measured
