#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace flexarm::response {

/// The largest product of a length and its largest prime factor that is transformed: some seconds.
inline constexpr double kMostTransformWork = 1e10;

std::size_t largest_prime_factor(std::size_t number);

/// The least number from `least` on without a prime factor above 5.
std::size_t next_smooth_number(std::size_t least);

/// x_j = Re sum_k amplitudes[k] exp(2 pi i j k/samples), j = 0 to samples - 1, by FFT.
/// `amplitudes` holds lines 0 to samples/2 at most; the work is that of `samples` times its largest
/// prime factor.
std::vector<double> sum_of_lines(std::vector<std::complex<double>> amplitudes, std::size_t samples);

}  // namespace flexarm::response
