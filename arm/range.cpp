#include "arm/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexarm::arm {

bool Range::contains(double value) const {
  return std::isfinite(value) && (exclusive ? value > minimum : value >= minimum);
}

std::string to_string(const Range& range) {
  if (std::isinf(range.minimum)) return "a finite number";
  return range.exclusive ? fmt::format("a finite number above {}", range.minimum)
                         : fmt::format("a finite number, {} or more", range.minimum);
}

}  // namespace flexarm::arm
