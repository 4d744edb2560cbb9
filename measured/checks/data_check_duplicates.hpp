#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Rows that are written twice while the times go on evenly: what follows is late by as many
/// periods.
struct Duplicates {
  std::vector<DataFinding> findings;  ///< one at most
  std::vector<std::size_t> rows;      ///< the copies, ascending
};

/// Seeks L rows, 1 <= L <= 64, that equal the L before them in all columns. Equal rows are a fault
/// only where chance makes less than 1e-3 of those of their length in the record. A signal repeats
/// a value by chance with a probability of step/(3.5 s), with the step of its readings and s =
/// robust deviation of its second differences around / sqrt(6), for noise and for a turning point
/// alike; or as often as it does without the others. Of L values it is that to the power L.
///
/// No such rows are rest (equal rows in a row, an angle that comes to rest and leaves, a velocity
/// of zero) and periods (L rows that equal those before for longer than 2 L).
///
/// `signals` are those of an evenly sampled record or of a part of it.
Duplicates check_duplicates(std::span<const CheckedSignal> signals);

/// Signals without some rows.
class ShortenedSignals {
 public:
  ShortenedSignals(std::span<const CheckedSignal> signals, const std::vector<std::size_t>& rows);

  std::span<const CheckedSignal> signals() const { return signals_; }
  /// Where the samples were before.
  const std::vector<std::size_t>& sample_of() const { return sample_of_; }

 private:
  std::vector<std::vector<double>> values_;
  std::vector<CheckedSignal> signals_;
  std::vector<std::size_t> sample_of_;
};

}  // namespace flexarm::measured
