#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// One row of a CSV file that holds anything, with the line it begins on.
struct CsvRow {
  int line = 0;
  std::vector<std::string> cells;  ///< without quotes and without blanks around
};

/// Splits CSV text (RFC 4180): cells between commas, quoted ones may hold commas, quotes as "" and
/// line ends. Lines end with LF, CRLF or CR; a UTF-8 byte-order mark, blank lines, and lines that
/// begin with # are passed over.
///
/// Throws InputError `FILE:LINE: ...` for a quote that is not closed, or text after a closed one.
std::vector<CsvRow> parse_csv(std::string_view text, const std::string& file_name);

}  // namespace flexarm::measured
