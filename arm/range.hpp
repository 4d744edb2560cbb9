#pragma once

#include <limits>
#include <string>

namespace flexarm::arm {

/// The finite numbers that a key may take: `value >= minimum`, or `value > minimum` where
/// `exclusive`.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  bool exclusive = false;

  /// Whether `value` is finite and inside.
  bool contains(double value) const;
};

inline constexpr Range kAnyFinite{};
inline constexpr Range kPositive{0.0, true};
inline constexpr Range kNotNegative{0.0, false};

/// What is allowed, in words: "a finite number above 0".
std::string to_string(const Range& range);

}  // namespace flexarm::arm
