#pragma once

#include "measured/files/frequency_record.hpp"

#include <span>
#include <vector>

namespace flexarm::diagnose {

/// Standard deviation of the white noise in a sampled signal [its unit]: from the quietest part of
/// its periodogram. Bands of equal width are averaged over `kNoiseBands`; the noise is the mean of
/// those that do not differ from the quietest by more than chance. A signal that fills the whole
/// spectrum leaves an upper bound.
double white_noise(std::span<const double> samples);
inline constexpr int kNoiseBands = 32;

/// Standard deviation of the real, and of the imaginary part of a response over its absolute
/// value, one a frequency. From the coherence,
///
///     sd^2 = (1 - g)/(2 n g)      (Bendat & Piersol, Random Data, (9.90)),
///
/// with the number n of averages, which the file does not give, from the scatter of the response
/// about its smooth course; from that scatter alone where the coherence is unknown.
std::vector<double> relative_scatter(const measured::FrequencyChannel& channel);

/// Standard deviations of entries without one, relative for the frequency, absolute for the ratio
/// of its size.
inline constexpr double kUnknownFrequency = 2e-3;
inline constexpr double kUnknownDampingRatio = 0.1;

}  // namespace flexarm::diagnose
