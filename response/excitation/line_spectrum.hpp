#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace flexarm::response {

std::size_t largest_prime_factor(std::size_t number);

/// A length with a prime factor above the first is transformed by a convolution, up to the second:
/// some seconds and less than 1 GB.
inline constexpr std::size_t kLargestFactorOfATransform = 100;
inline constexpr std::size_t kMostSamplesOfALargeFactor = 5'000'000;

/// The least number from `least` on without a prime factor above 5.
std::size_t next_smooth_number(std::size_t least);

/// x_j = Re sum_k amplitudes[k] exp(2 pi i j k/samples), j = 0 to samples - 1, by FFT.
/// `amplitudes` holds lines 0 to samples/2 at most.
std::vector<double> sum_of_lines(std::vector<std::complex<double>> amplitudes, std::size_t samples);

}  // namespace flexarm::response
