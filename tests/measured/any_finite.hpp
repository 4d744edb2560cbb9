#pragma once

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace flexarm::measured {

/// Any finite double, subnormal ones included.
inline double any_finite(std::mt19937_64& random) {
  double value = std::numeric_limits<double>::quiet_NaN();
  while (!std::isfinite(value)) value = std::bit_cast<double>(random());
  return value;
}

}  // namespace flexarm::measured
