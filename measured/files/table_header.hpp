#pragma once

#include "measured/files/foreign_table.hpp"
#include "measured/files/table_reading.hpp"
#include "measured/files/text_lines.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// Names and units in front of the rows of a delimited text.
struct TableHeader {
  std::vector<ForeignColumn> columns;  ///< one a cell; no name where the file has none
  std::vector<std::string> sentences;  ///< on the lines that they are in
};

/// The header above the row `first` of `sample`: a line of names, perhaps with one of units below
/// or above it, or none. A line of one name fewer than cells has those of the last columns where
/// the first one has the numbers of the rows or quoted names of rows, as R writes tables.
///
/// Throws InputError, with its line in `line`, for a unit that differs from that in the name, time
/// stamps with a decimal comma between commas, numbers with one, and names that may belong to the
/// last columns.
TableHeader read_table_header(std::span<const TextLine> sample, const TableReading& reading,
                              std::size_t first, int& line);

}  // namespace flexarm::measured
