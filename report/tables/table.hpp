#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::report {

/// One value of a table: missing, a number, a count, or text. NaN counts as missing.
using Cell = std::variant<std::monostate, double, std::int64_t, std::string>;

inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// How a terminal table prints a number; CSV always carries full double precision.
enum class Notation {
  general,     ///< as many digits as asked for, an exponent only where the number needs one
  scientific,  ///< always with an exponent: errors, tolerances
};

struct Column {
  std::string name;
  std::string unit = {};  ///< empty: none is shown
  int significant_digits = 6;
  Notation notation = Notation::general;
  bool joined = false;  ///< qualifies the column before it: stays beside it on a narrow terminal
};

/// A column of errors: two digits, scientific notation.
Column error_column(std::string name, std::string unit = "");

/// A column that qualifies the one before it: a standard error, a deviation.
Column qualifying(std::string name, std::string unit, int significant_digits);

/// Rows of cells under named columns; `to_text` and `to_csv` are two views of one table.
struct Table {
  std::string caption;  ///< the line above the table on a terminal; empty: none
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows = {};

  /// Throws std::invalid_argument unless `row` has one cell a column.
  void add_row(std::vector<Cell> row);
};

/// An explained share from 0 to 1: what makes residuals larger explains nothing of them.
double explained_share(double share);

/// Returns the explained share in %.
double explained_percent(double share);

/// True for a missing cell and for NaN.
bool is_missing(const Cell& cell);

}  // namespace flexarm::report
