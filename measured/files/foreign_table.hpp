#pragma once

#include "measured/files/time_stamp.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// A column of a log that was not made for this program.
struct ForeignColumn {
  std::string name;  ///< as the file has it, unit and all: "Time (ms)"; "column 3" without
  std::string unit;  ///< told by the file, as `canonical_unit` has it; empty: not told
  std::vector<double> values;           ///< NaN for an empty cell; none in a column of text
  std::vector<std::string> texts = {};  ///< in place of the values in a column of text
  bool is_stamp = false;                ///< seconds of time stamps, clocks or dates in the file
  bool is_made = false;                 ///< times of a start and a period that the file tells
  bool is_left_out = false;             ///< by the user: no quantity by its name
  std::string path = {};                ///< where it stands in a file of structures; empty: by name
  std::string stray = {};     ///< the only text of a column that has numbers besides; empty: none
  std::size_t stray_row = 0;  ///< where it stands first
  /// Holds the moment at which a time is 0, of time stamps or of the head of a file; empty: not
  /// told.
  std::optional<ClockStart> start = std::nullopt;

  bool is_text() const { return !texts.empty(); }
  /// Whether it has no number at all.
  bool holds_nothing() const;
};

/// Whether a column has times, by its name or unit.
bool is_time_column(const ForeignColumn& column);

/// Named columns of numbers, and what was assumed to get them, a sentence each.
struct ForeignTable {
  std::vector<ForeignColumn> columns;
  std::vector<int> line_of_row;  ///< empty where the file has no lines
  std::vector<std::string> assumptions;
};

/// "hub_angle = #FOO in line 3: no number, as its other cells are; ...", of the columns of `table`
/// that are text for one sign alone, or that are by their names numbers and hold texts with digits.
std::vector<std::string> stray_texts(const ForeignTable& table);

/// Where the column of that name is (`column_place`); several may have one name. Throws InputError
/// with the columns there are, and the one that was probably meant.
std::size_t find_column(const ForeignTable& table, std::string_view name);

/// "FILE:LINE: " row of the table in front of an error.
int line_of(const ForeignTable& table, std::size_t row);

/// Reads delimited text of any common kind: cells between commas, semicolons, tabs or blanks; a
/// decimal point or comma; lines that end in LF, CRLF or CR; UTF-8, Latin-1, or UTF-16 with a
/// byte-order mark; lines of anything in front; a line of names, or none, and perhaps one of units;
/// comments (#, %, //), quoted cells, separators at the end of lines. The separator and the decimal
/// mark are those that make most cells numbers. Time stamps become seconds since the first one
/// (measured/files/time_stamp.hpp). Heads of instruments tell the times of a file without a column
/// of them (measured/files/sampling_settings.hpp, measured/files/instrument_head.hpp). A LabVIEW
/// measurement file is read as measured/files/labview_text.hpp says.
///
/// Throws InputError `FILE:LINE: what is wrong; what is allowed` for a file that is not text, has
/// no two rows of two numbers or more (of one in less than ten rows), rows of unlike
/// length, a cell that is no number in a column of numbers, and thousands separators. A last line
/// that is cut off is left out, and said.
ForeignTable read_foreign_table(const std::filesystem::path& path);

/// The same for the bytes of a file; `file_name` stands in the errors.
ForeignTable parse_foreign_table(std::string_view bytes, const std::string& file_name);

}  // namespace flexarm::measured
