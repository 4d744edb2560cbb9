#pragma once

#include "measured/files/measurement.hpp"
#include "measured/files/time_record.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What the times of an uneven record are taken for.
enum class Clock {
  stamped,  ///< the instants at which the samples were taken
  even,     ///< stamps that came late of samples that were taken evenly
};

/// "stamped", "even".
std::string_view to_string(Clock clock);

struct EvenOptions {
  Clock clock = Clock::stamped;
  TorqueHold torque_hold = TorqueHold::zero;
  /// A gap of missing samples <= this is filled by interpolation; a longer one splits the record.
  std::size_t longest_filled_gap = 3;
  /// Holds the sampling period of a record that was even before samples were taken out; each time
  /// is on this grid. Empty: not known.
  std::optional<double> period_s = std::nullopt;
  /// A stretch of samples < this is left out.
  std::size_t fewest_samples = 10;
};

/// A record on an even grid, in stretches.
struct EvenRecords {
  std::vector<TimeRecord> stretches;
  std::vector<std::string> notes;  ///< a sentence on each thing that was done to the times
  bool has_first_sample = true;    ///< of the record, in the first stretch
};

/// Puts a record whose times need not be even on even grids. A record that `grid_fault` finds no
/// fault with is returned as it is. Otherwise, in this order:
///
/// - Where times go back the record is split; of samples with the same time the first is kept.
/// - Times that lie on an even grid up to their own last digit are replaced by the grid: they are
///   rounded. A digit above two periods must leave the period open by 0.1 % or less.
/// - Where the sampling period changes (`period_changes`) the record is split.
/// - A gap (`clock_steps`) splits the record, or is filled.
/// - A stretch that is uneven by more than `kMostJitter_periods` is resampled to its median period:
///   sensors by the cubic through the four nearest samples, where samples closer than 0.3 periods
///   count as one, their mean; a torque of zero-order hold by its mean over each new step, which
///   keeps its impulse; one of first-order hold linearly. A reference is held like the torque that
///   a controller makes of it, and so is its mean over each new step. With `Clock::even` the times
///   alone are replaced.
///
/// With `EvenOptions::period_s` there are only gaps, the steps above that period.
///
/// `record` has two samples or more. Throws InputError where no stretch is long enough,
/// where rounded times leave the period open, and where times repeat whose rows differ: in four
/// tenths of the samples or more of times that are not rounded, or as often at every time.
EvenRecords make_even(const TimeRecord& record, const EvenOptions& options = {});

}  // namespace flexarm::measured
