#include "measured/spectra/fourier.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <numbers>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

bool has_no_factor_above(std::size_t number, std::size_t largest) {
  for (std::size_t factor = 2; factor <= largest; ++factor) {
    while (number % factor == 0) number /= factor;
  }
  return number == 1;
}

/// The transform's own lengths.
constexpr std::size_t kLargestFactor = 7;

}  // namespace

std::size_t fast_length(std::size_t least) {
  std::size_t quarter = std::max<std::size_t>(1, (least + 3) / 4);
  while (!has_no_factor_above(quarter, 5)) ++quarter;
  return 4 * quarter;
}

std::size_t fast_length_within(std::size_t most) {
  while (!has_no_factor_above(most, 5)) --most;
  return most;
}

RealTransform::RealTransform(std::size_t samples) : samples_(samples) {
  if (samples < 1 || samples > kMostSamples) {
    throw arm::InputError(
        fmt::format("a transform of {} samples; must be from 1 to {}", samples, kMostSamples));
  }
  transform_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  transform_.SetFlag(Eigen::FFT<double>::Unscaled);
  if (has_no_factor_above(samples, kLargestFactor)) return;

  // j k = (j^2 + k^2 - (k - j)^2)/2, so that X_k = c_k sum_j (x_j c_j) conj(c_{k-j}) with
  // c_j = exp(-i pi j^2/n). j^2 is reduced modulo 2 n before it becomes an angle.
  const std::size_t padded = fast_length(samples + lines());
  chirp_.resize(samples);
  for (std::size_t j = 0; j < samples; ++j) {
    const double angle = std::numbers::pi * static_cast<double>(j * j % (2 * samples)) /
                         static_cast<double>(samples);
    chirp_[j] = std::polar(1.0, -angle);
  }
  std::vector<Complex> wrapped(padded);
  for (std::size_t j = 0; j < lines(); ++j) wrapped[j] = std::conj(chirp_[j]);
  for (std::size_t j = 1; j < samples; ++j) wrapped[padded - j] = std::conj(chirp_[j]);
  kernel_.resize(padded);
  padded_.resize(padded);
  product_.resize(padded);
  transform_.fwd(kernel_.data(), wrapped.data(), static_cast<Eigen::Index>(padded));
  for (auto& value : kernel_) value /= static_cast<double>(padded);
}

void RealTransform::operator()(std::span<const double> values, std::span<Complex> spectrum) {
  if (samples_ == 1) {
    spectrum[0] = values[0];
    return;
  }
  if (!chirp_.empty()) {
    by_convolution(values, spectrum);
    return;
  }
  transform_.fwd(spectrum.data(), values.data(), static_cast<Eigen::Index>(samples_));
}

void RealTransform::by_convolution(std::span<const double> values, std::span<Complex> spectrum) {
  std::fill(padded_.begin(), padded_.end(), Complex{});
  for (std::size_t j = 0; j < samples_; ++j) padded_[j] = values[j] * chirp_[j];
  const auto length = static_cast<Eigen::Index>(padded_.size());
  transform_.fwd(product_.data(), padded_.data(), length);
  for (std::size_t k = 0; k < product_.size(); ++k) product_[k] *= kernel_[k];
  transform_.inv(padded_.data(), product_.data(), length);
  for (std::size_t k = 0; k < lines(); ++k) spectrum[k] = padded_[k] * chirp_[k];
}

}  // namespace flexarm::measured
