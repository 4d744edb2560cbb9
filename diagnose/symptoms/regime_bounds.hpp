#pragma once

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// The values of one regime: above `from` and up to `to`. Those of the first regime of a quantity
/// begin at `from`; a regime of one value has it as both.
struct RegimeBounds {
  double from = 0.0;
  double to = 0.0;
};

/// Returns regimes of a quantity that hold equally many of its values, kRegimes of them or fewer:
/// its quartiles. A value that fills more than one quartile is the end of one regime. Of kRegimes
/// values or fewer each is a regime. Values that differ by less than kSameValue of the largest one
/// are the same.
std::vector<RegimeBounds> equal_regimes(std::vector<double> values);
inline constexpr std::size_t kRegimes = 4;
/// Part of the largest value that a recorded torque of one level varies by.
inline constexpr double kSameValue = 0.01;

/// Returns the parts of equal length from 0 to `to`.
std::vector<RegimeBounds> equal_parts(double to);

}  // namespace flexarm::diagnose
