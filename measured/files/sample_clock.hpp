#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// What follows a step of a clock, in periods of the even grid: 1, more after a gap, 0 where the
/// time repeats or goes back.
struct ClockSteps {
  /// The median step where 80 % of the steps are within 10 % of it; otherwise that over 16 samples,
  /// divided by 16.
  double period_s = 0.0;
  std::vector<double> periods;  ///< one a sample; the first is 0
  std::vector<std::size_t> gaps;
  std::vector<std::size_t> backward;
};

/// A gap is a step above 1.5 periods that the times do not make up for: with e_k = t_k/period - k,
/// the medians of e over the eight samples before and after it differ by more than 0.7 of a period.
/// A sample that is merely late, and a burst after a stall, leave the medians where they are.
/// `times_s` holds two finite times or more.
ClockSteps clock_steps(std::span<const double> times_s);

/// How far times lie off the even grid a + period k with a and period by least squares, gaps
/// counted.
struct Jitter {
  double period_s = 0.0;
  double most_periods = 0.0;
  double rms_periods = 0.0;
  /// From the earliest to the latest, relative to the grid.
  double range_periods = 0.0;
  std::size_t first_beyond = 0;  ///< the first sample off by more than `most_periods` allowed
};

/// The jitter of the samples [first, last), two or more; `last` in `first_beyond` for none.
Jitter jitter_of(std::span<const double> times_s, const ClockSteps& steps, std::size_t first,
                 std::size_t last, double most_periods);

}  // namespace flexarm::measured
