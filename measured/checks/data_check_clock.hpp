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

/// Finds times that repeat or go back, gaps (`clock_steps`), and jitter. `times_s` holds two finite
/// times or more.
ClockCheck check_clock(std::span<const double> times_s, const DataCheckOptions& options);

}  // namespace flexarm::measured
