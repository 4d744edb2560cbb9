#pragma once

#include <unsupported/Eigen/FFT>

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// The discrete Fourier transform of real signals of one length, whatever that is:
/// X_k = sum_j x_j exp(-2 pi i j k/n), k = 0 to n/2.
///
/// A length with prime factors up to 7 is transformed as it is; one with larger factors by
/// Bluestein's chirp convolution of a length that has none. Work n log n, memory of a few signals.
class RealTransform {
 public:
  /// `samples` from 1 to kMostSamples; throws InputError.
  explicit RealTransform(std::size_t samples);
  static constexpr std::size_t kMostSamples = std::size_t{1} << 28;

  std::size_t samples() const { return samples_; }
  /// samples/2 + 1.
  std::size_t lines() const { return samples_ / 2 + 1; }
  /// `values` has `samples()` values, `spectrum` room for `lines()`.
  void operator()(std::span<const double> values, std::span<std::complex<double>> spectrum);

 private:
  void by_convolution(std::span<const double> values, std::span<std::complex<double>> spectrum);

  std::size_t samples_;
  Eigen::FFT<double> transform_;
  /// Of Bluestein's convolution; empty where the length needs none.
  std::vector<std::complex<double>> chirp_;
  std::vector<std::complex<double>> kernel_;
  std::vector<std::complex<double>> padded_;
  std::vector<std::complex<double>> product_;
};

/// The least number from `least` on that is a multiple of 4 without a prime factor above 5: the
/// lengths that are fastest to transform.
std::size_t fast_length(std::size_t least);

/// The largest number up to `most`, 1 or more, without a prime factor above 5.
std::size_t fast_length_within(std::size_t most);

}  // namespace flexarm::measured
