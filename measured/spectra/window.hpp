#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What a segment is multiplied by before it is transformed.
enum class Window { rectangular, hann, hamming, blackman, flat_top };

/// "rectangular", "hann", "hamming", "blackman", "flat-top".
std::string_view to_string(Window window);
/// The window of that name; throws InputError with the names allowed.
Window parse_window(std::string_view name);

/// w_j = sum_m (-1)^m a_m cos(2 pi m j/samples), j = 0 to samples - 1: the periodic form, whose
/// transform is zero on all lines but the 2 m + 1 lowest ([Harris1978]; flat-top
/// [DAntonaFerrero2006]). `samples` is 1 or more.
std::vector<double> window_values(Window window, std::size_t samples);

/// Equivalent noise bandwidth in lines, n sum w^2/(sum w)^2: white noise behind a line of the
/// spectrum is that of this many lines. 1 for the rectangle, 3/2 for Hann.
double noise_bandwidth_lines(std::span<const double> window);

/// Sum over lines of the correlation of their powers with one line's, for noise behind the window:
/// sum_m |sum_j w_j^2 exp(2 pi i m j/n)|^2/(sum w^2)^2. A mean over many lines varies by this more
/// than one over as many independent ones: 1 for the rectangle, 35/18 for Hann.
double shared_line_variance(Window window);

/// sum_j w_j w_{j + shift}/sum w^2: what the transforms of two segments of white noise that lie
/// `shift` samples apart have in common [Welch1967].
double overlap_correlation(std::span<const double> window, std::size_t shift);

/// The number of independent segments whose mean spectrum varies as much as that of `segments`
/// segments of white normal noise, each `shift` samples behind the one before [Welch1967]:
///
///     K/(1 + 2 sum_{k=1}^{K-1} (1 - k/K) rho_k^2),   rho_k = overlap_correlation(window, k shift).
double effective_averages(std::span<const double> window, std::size_t segments, std::size_t shift);

/// The part by which segments overlap unless told: the least of 0, 1/2, 2/3, 3/4, 5/6 at which a
/// long record has as many effective averages as at 5/6, to 3 %. 2/3 for Hann.
double sufficient_overlap(Window window);

/// Half of the lines that a sine on a line spreads over: outside so many lines from it the
/// transform of the window is zero. 1 for the rectangle, 2 for Hann.
int main_lobe_lines(Window window);

}  // namespace flexarm::measured
