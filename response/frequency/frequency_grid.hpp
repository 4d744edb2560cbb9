#pragma once

#include <complex>
#include <span>
#include <vector>

namespace flexarm::response {

/// Frequencies at which a response is looked at.
struct FrequencyGrid {
  double from_Hz = 0.1;
  double to_Hz = 100.0;
  int points = 400;  ///< spaced evenly on a logarithmic axis, both ends included
};

/// Upper bound of `points`.
inline constexpr int kMostFrequencies = 1'000'000;

/// `points` frequencies from `from_Hz` to `to_Hz`, evenly spaced on a logarithmic axis.
/// Throws InputError unless 0 < from < to, both finite, and 2 <= points <= kMostFrequencies.
std::vector<double> logarithmic_frequencies(const FrequencyGrid& grid);

/// The same with further frequencies on both sides of each of `features`, poles or zeros
/// s [rad/s]: at w +- d, w +- 2 d, w +- 4 d, ... up to the spacing of the grid, with w = |Im s| and
/// d a quarter of the half-width |Re s|, at least 1e-4 w; and at w itself where Re s is not 0. So a
/// peak has ten points or so within its half-width, and the flanks of one without damping are drawn
/// to ten thousand times the grid's own. Ascending, none twice.
std::vector<double> refined_frequencies(const FrequencyGrid& grid,
                                        std::span<const std::complex<double>> features_rad_per_s);

/// Throws InputError, with `key` in front, unless there is one frequency at least, each finite,
/// above 0 and above the one before.
void require_ascending(std::span<const double> frequency_Hz, const char* key);

}  // namespace flexarm::response
