#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace flexarm::response {

/// Random numbers that a seed determines on every platform: the generator is the standard's
/// mt19937_64, the distributions are the formulas below. (Normal numbers differ between platforms
/// by the rounding of log, sin and cos at most.)
class RandomNumbers {
 public:
  /// Different streams of one seed are unrelated.
  explicit RandomNumbers(std::uint64_t seed, std::uint32_t stream = 0);

  /// Uniform in (0, 1): (the upper 53 bits + 1/2) 2^-53.
  double uniform();
  /// Normal with mean 0 and standard deviation 1: sqrt(-2 log u) cos(2 pi v) of uniform u, v
  /// [BoxMuller1958].
  double normal();
  /// Whole, uniform from 0 to `count` - 1, of one uniform number; `count` far below 2^53.
  std::size_t below(std::size_t count);

 private:
  std::mt19937_64 generator_;
};

}  // namespace flexarm::response
