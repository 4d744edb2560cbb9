#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace flexarm::measured {

/// The last part of a signal repeats itself.
struct Period {
  std::size_t samples = 0;  ///< a period
  std::size_t periods = 0;  ///< whole ones at the end of the record, 2 or more
  /// Mean square of what a period differs from the one before by, over twice that of the signal.
  double mismatch = 0.0;
};

/// How unlike periods may be: mismatch <= 0.01, noise of a tenth of the signal.
inline constexpr double kMostMismatch = 0.01;

/// The shortest whole number of samples after which the last half of `values`, or more, repeats
/// itself: by the correlation of a piece of the second half with all that lies before it, then
/// sample by sample. None where there is none, where the signal is constant, and where the period
/// is no whole number of samples: where a shift explains most of what periods differ by. Work n log
/// n, memory of a few records.
std::optional<Period> find_period(std::span<const double> values);

/// How many whole periods of `period_samples` at the end repeat each other; 1 or more where the
/// record holds one, its mismatch 0 for one.
Period periods_of(std::span<const double> values, std::size_t period_samples);

}  // namespace flexarm::measured
