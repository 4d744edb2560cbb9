#include "response/excitation/line_spectrum.hpp"

#include <unsupported/Eigen/FFT>

#include <numbers>

namespace flexarm::response {

namespace {

using Complex = std::complex<double>;

/// Bluestein's convolution: 2 j k = j^2 + k^2 - (j - k)^2, so that the sum is
/// c_j sum_k a_k c_k conj(c_{j-k}) with c_j = exp(i pi j^2/samples). For the angle j^2 is taken
/// modulo 2 samples. measured/ transforms what is recorded likewise, by code of its own, so
/// that signals and their analysis share none.
std::vector<double> by_convolution(const std::vector<Complex>& amplitudes, std::size_t samples,
                                   Eigen::FFT<double>& transform) {
  std::vector<Complex> chirp(samples);
  for (std::size_t j = 0; j < samples; ++j) {
    const auto square = static_cast<double>(j * j % (2 * samples));
    chirp[j] = std::polar(1.0, std::numbers::pi * square / static_cast<double>(samples));
  }
  const std::size_t lines = amplitudes.size();
  const std::size_t padded = next_smooth_number(samples + lines - 1);
  std::vector<Complex> weighted(padded);
  std::vector<Complex> kernel(padded);
  for (std::size_t k = 0; k < lines; ++k) weighted[k] = amplitudes[k] * chirp[k];
  for (std::size_t j = 0; j < samples; ++j) kernel[j] = std::conj(chirp[j]);
  for (std::size_t k = 1; k < lines; ++k) kernel[padded - k] = std::conj(chirp[k]);
  const auto length = static_cast<Eigen::Index>(padded);
  std::vector<Complex> spectrum(padded);
  std::vector<Complex> kernel_spectrum(padded);
  transform.fwd(spectrum.data(), weighted.data(), length);
  transform.fwd(kernel_spectrum.data(), kernel.data(), length);
  for (std::size_t k = 0; k < padded; ++k) spectrum[k] *= kernel_spectrum[k];
  std::vector<Complex>& convolved = weighted;
  transform.inv(convolved.data(), spectrum.data(), length);
  std::vector<double> values(samples);
  for (std::size_t j = 0; j < samples; ++j) {
    values[j] = (convolved[j] * chirp[j]).real() / static_cast<double>(padded);
  }
  return values;
}

}  // namespace

std::size_t largest_prime_factor(std::size_t number) {
  std::size_t largest = 1;
  for (std::size_t factor = 2; factor * factor <= number; ++factor) {
    for (; number % factor == 0; number /= factor) largest = factor;
  }
  return number > 1 ? number : largest;
}

std::size_t next_smooth_number(std::size_t least) {
  constexpr std::size_t kLargestFactor = 5;
  while (largest_prime_factor(least) > kLargestFactor) ++least;
  return least;
}

std::vector<double> sum_of_lines(std::vector<Complex> amplitudes, std::size_t samples) {
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::Unscaled);
  if (largest_prime_factor(samples) > kLargestFactorOfATransform) {
    return by_convolution(amplitudes, samples, transform);
  }
  amplitudes.resize(samples);
  std::vector<Complex> sums;
  transform.inv(sums, amplitudes);
  std::vector<double> values(samples);
  for (std::size_t j = 0; j < samples; ++j) values[j] = sums[j].real();
  return values;
}

}  // namespace flexarm::response
