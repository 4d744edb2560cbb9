#pragma once

#include "report/tables/table.hpp"
#include "report/terminal.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace flexarm::report {

struct TextOptions {
  std::size_t max_width = kPipeWidth;  ///< terminal columns; lines <= max_width
  std::size_t key_columns = 1;  ///< columns that are repeated when a table is continued below
};

/// The table for a terminal: caption, names, units, a rule, rows; each line ends in '\n', without
/// trailing blanks. Columns of numbers are right-aligned on the decimal point, text is
/// left-aligned, what is missing is "-". Where the columns do not fit in `max_width` beside each
/// other, names are broken at their blanks; then the widest column of text; then the table is
/// parted into blocks below each other, behind the key columns (`balanced_blocks`). Where a column
/// does not fit beside the key columns, each cell has a line "name [unit]: value".
std::string to_text(const Table& table, const TextOptions& options = {});

/// The table with its first `most` rows.
Table first_rows(const Table& table, std::size_t most);

/// One cell as `to_text` prints it, not padded; "-" for a missing one.
std::string cell_text(const Cell& cell, const Column& column);

/// `value` with exactly `significant_digits`, trailing zeros included ("12.0000"); 0 is "0".
std::string format_number(double value, int significant_digits, Notation notation);

/// A paragraph for a terminal: `text` broken at blanks into lines of at most `max_width` columns
/// where its words allow it; each line ends in '\n'. The first is indented as `text` is, the others
/// by `indent`.
std::string to_paragraph(std::string_view text, std::size_t indent = 0,
                         std::size_t max_width = TextOptions{}.max_width);

}  // namespace flexarm::report
