#pragma once

#include "measured/files/foreign_table.hpp"
#include "measured/files/measurement.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// The times of a run whose signals stand in several files.
enum class JoinGrid {
  same,      ///< those of all files, which have samples at the same times
  first,     ///< those of the first file
  coarsest,  ///< those of the file with the longest sampling period
};

/// "same", "first", "coarsest".
std::string_view to_string(JoinGrid grid);

/// Signals of one file, all but its time.
struct TimedSignals {
  std::string file;             ///< as it may stand in a line
  std::vector<double> times_s;  ///< strictly increasing, two or more, one clock for all files
  std::vector<ForeignColumn> columns;  ///< of numbers, as long; NaN where one is missing
  std::optional<ClockStart> start = std::nullopt;  ///< moment at which the time is 0, if told
  bool is_stamped = false;                         ///< times of stamps, which count from `start`
};

/// One table of the signals of several files: "time [s]", then their columns, over the time in
/// which all files have samples. Columns of one name, and those whose name says nothing ("value"),
/// get that of their file in front, "torque.value". What was done is among the assumptions.
///
/// Samples that lie within 0.05 periods of each other are at the same time. A file of the same
/// period that lacks some of the samples has NaN there. With another grid than
/// `same`, the signals of the other files are taken at its times: of one that `is_held` by its mean
/// over each step, of any other by the cubic through the four nearest samples. NaN is no sample.
/// Where samples are missing, a step of more than 1.5 periods of the signal, the table has NaN.
///
/// Throws InputError for files without common time, and with `same` for other times.
ForeignTable joined_table(std::vector<TimedSignals> files, JoinGrid grid,
                          const std::function<bool(const std::string& column)>& is_held);

/// The names of the columns as they would be, without the time.
void name_joined_columns(std::vector<TimedSignals>& files);

}  // namespace flexarm::measured
