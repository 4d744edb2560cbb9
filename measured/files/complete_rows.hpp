#pragma once

#include "measured/files/column_mapping.hpp"
#include "measured/files/foreign_table.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {

/// How the empty cells of a column that was written at a rate of its own are filled.
enum class Between {
  hold,    ///< the number above
  linear,  ///< the line over time between the numbers above and below
  rows,    ///< nothing: rows with an empty cell are left out
};

/// Columns at rates of their own, by standard name or `kReferenceColumn`.
using OwnRates = std::map<std::string, Between>;

/// The rows of a log that have a number in each column that is used.
struct CompleteRows {
  std::vector<std::size_t> rows;  ///< that are left, by their places in the file, from 0
  std::size_t rows_in_file = 0;
  /// Whether a torque acts in the incomplete rows in front of the first complete one.
  bool is_driven_before = false;
  /// Holds the distance of an even grid, in the unit of the file: that of all rows, or of all rows
  /// with a number beside the time. Empty for uneven times, where no row is left out, and with
  /// `Between::rows`.
  std::optional<double> period;
  std::vector<std::string> notes;     ///< a sentence on what was filled or left out
  std::vector<std::string> warnings;  ///< a sentence on what may be missing samples
};

/// Leaves out the rows of `table` that have no number in a column that `mappings`, the reference of
/// a closed loop (null without) or a standard header takes, as if they were not in the file.
///
/// Signs of instruments (`take_out_over_range`) are missing numbers; of `doubtful_signs` is warned.
///
/// A column is written at its own rate if the median distance of its numbers is two rows or more,
/// of those rows that have a number in any such column but the time. Throws InputError for one that
/// `own_rates` does not name, for a name there that no column has, and for a column that a mapping
/// takes and that has no number.
CompleteRows keep_complete_rows(ForeignTable& table, const ColumnMappings& mappings,
                                const ColumnMapping* reference, const OwnRates& own_rates);

}  // namespace flexarm::measured
