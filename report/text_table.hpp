#pragma once

#include "report/table.hpp"

#include <cstddef>
#include <string>

namespace flexarm::report {

struct TextOptions {
  std::size_t max_width = 100;  ///< terminal columns; lines <= max_width where columns allow it
  std::size_t key_columns = 1;  ///< columns that are repeated when a table is continued below
};

/// The table for a terminal: caption, names, units, a rule, rows; each line ends in '\n', without
/// trailing blanks. Columns of numbers are right-aligned on the decimal point, text is
/// left-aligned, what is missing is "-". Columns that do not fit in `max_width` go to a block of
/// their own below, behind the key columns.
std::string to_text(const Table& table, const TextOptions& options = {});

/// `value` with exactly `significant_digits`, trailing zeros included ("12.0000"); 0 is "0".
std::string format_number(double value, int significant_digits, Notation notation);

}  // namespace flexarm::report
