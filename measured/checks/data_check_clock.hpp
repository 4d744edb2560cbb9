#pragma once

#include "measured/checks/data_check.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// What the times of a record say.
struct ClockCheck {
  std::vector<DataFinding> findings;
  double period_s = 0.0;
  /// The longest stretch without gap and without a step back: samples [first, first + count).
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Finds times that repeat or go back, gaps, and jitter. `times_s` holds two finite times or more.
///
/// A gap is a step that the times do not make up for: with e_k = t_k/period - k, the medians of e
/// over the eight samples before and after it differ by more than 0.7 of a period. A time that is
/// merely late leaves the medians where they are.
ClockCheck check_clock(std::span<const double> times_s, const DataCheckOptions& options);

}  // namespace flexarm::measured
