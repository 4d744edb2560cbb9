#pragma once

#include "response/time/random_numbers.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace flexarm::measured {

inline constexpr double kTwoPi = 2.0 * std::numbers::pi;
/// Between samples.
inline constexpr double kPeriod_s = 0.005;

/// White normal noise of standard deviation 1.
inline std::vector<double> white_noise(std::size_t samples, std::uint64_t seed,
                                       std::uint32_t stream = 0) {
  response::RandomNumbers random(seed, stream);
  std::vector<double> values(samples);
  for (double& value : values) value = random.normal();
  return values;
}

/// sum_j x_j exp(-2 pi i j k/n) term by term.
inline std::complex<double> direct_line(std::span<const double> values, std::size_t k) {
  std::complex<double> sum = 0.0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    sum += values[j] * std::polar(1.0, -kTwoPi * static_cast<double>(j * k % values.size()) /
                                           static_cast<double>(values.size()));
  }
  return sum;
}

inline double mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

}  // namespace flexarm::measured
