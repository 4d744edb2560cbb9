#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// Reads CSV text (RFC 4180) row by row, without a copy of what is not quoted: cells between
/// commas, quoted ones may hold commas, quotes as "" and line ends. Lines end with LF, CRLF or CR;
/// a UTF-8 byte-order mark, blank lines, and lines that begin with # are passed over.
class CsvReader {
 public:
  /// `text` must outlive the reader.
  explicit CsvReader(std::string_view text);

  /// Goes to the next row; false when there is none. Throws InputError, to be located at `line()`,
  /// for a quote that is not closed, or text after a closed one, and for more cells than
  /// `kMostRecordColumns`.
  bool next();
  /// The line on which the row begins, from 1; after an error, the line that it is about.
  int line() const { return row_line_; }
  /// The row's cells without quotes and without blanks around; valid until the next call of `next`.
  std::span<const std::string_view> cells() const { return cells_; }

 private:
  bool pass_what_is_no_row();
  std::string_view plain_cell();
  std::string_view quoted_cell();
  void end_quoted_cell();
  void pass_blanks();
  void pass_line_end();

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int row_line_ = 1;
  std::vector<std::string_view> cells_;
  std::deque<std::string> rewritten_;  ///< cells with quotes in them, which are no part of the text
};

/// One row of a CSV file that holds anything, with the line it begins on.
struct CsvRow {
  int line = 0;
  std::vector<std::string> cells;
};

/// All rows of a small file. Throws InputError `FILE:LINE: ...` where CsvReader throws.
std::vector<CsvRow> parse_csv(std::string_view text, const std::string& file_name);

}  // namespace flexarm::measured
