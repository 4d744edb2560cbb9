#include "response/excitation/line_spectrum.hpp"

#include <unsupported/Eigen/FFT>

namespace flexarm::response {

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

std::vector<double> sum_of_lines(std::vector<std::complex<double>> amplitudes,
                                 std::size_t samples) {
  amplitudes.resize(samples);
  std::vector<std::complex<double>> sums;
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::Unscaled);
  transform.inv(sums, amplitudes);
  std::vector<double> values(samples);
  for (std::size_t j = 0; j < samples; ++j) values[j] = sums[j].real();
  return values;
}

}  // namespace flexarm::response
