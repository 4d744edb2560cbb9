#pragma once

#include <cstddef>
#include <vector>

namespace flexarm::report {

/// Limits of an axis that outliers do not set.
struct RobustRange {
  double low = 0.0;
  double high = 0.0;
  std::size_t outside = 0;  ///< values beyond them
};

/// The extremes of `values`, one at least, without outliers. Of n values, an outlier is among the
/// n/200 lowest or highest (one at least where n >= 20), and beyond the others by more than twice
/// the range that these have.
RobustRange robust_range(std::vector<double> values);

}  // namespace flexarm::report
