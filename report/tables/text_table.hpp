#pragma once

#include "report/tables/table.hpp"

#include <cstddef>
#include <string>
#include <string_view>

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

/// A paragraph for a terminal: `text` broken at blanks into lines of at most `max_width` columns
/// where its words allow it, all but the first indented; each line ends in '\n'.
std::string to_paragraph(std::string_view text, std::size_t indent = 0,
                         std::size_t max_width = TextOptions{}.max_width);

}  // namespace flexarm::report
