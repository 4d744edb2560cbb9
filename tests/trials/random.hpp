#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace flexarm::trials {

/// Random numbers of one purpose: the same for the same seed and purpose on every platform.
class Random {
 public:
  Random(std::uint64_t seed, std::string_view purpose);

  /// In (0, 1).
  double uniform();
  double uniform(double lowest, double highest) { return lowest + (highest - lowest) * uniform(); }
  /// Mean 0, standard deviation 1: sqrt(-2 log u) cos(2 pi v), [BoxMuller1958].
  double normal();
  /// -1 or 1.
  double sign() { return uniform() < 0.5 ? -1.0 : 1.0; }
  /// From 0 to `count` - 1.
  std::size_t below(std::size_t count);

 private:
  std::mt19937_64 generator_;
};

}  // namespace flexarm::trials
