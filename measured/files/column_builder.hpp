#pragma once

#include "measured/files/foreign_table.hpp"
#include "measured/files/time_stamp.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// Makes the columns of a table of the cells of its rows. The first cell that is not empty tells
/// whether a column has numbers, time stamps or texts.
class ColumnBuilder {
 public:
  /// `columns` have names and units; `decimal` is the mark of the numbers.
  ColumnBuilder(std::vector<ForeignColumn> columns, char decimal);

  /// A column of texts, whatever its cells are.
  void take_as_text(std::size_t column);

  /// One cell a column; empty cells and signs of a missing number (NaN, NA, -, ...) are NaN, those
  /// of a number beyond a range (OVLD, ...) infinite. Throws
  /// InputError for a cell that is no number in a column of numbers, and for thousands separators.
  void add_row(std::span<const std::string_view> cells, int line);

  /// The table. A column of numbers that all have one unit behind them, "0.002 sec", is in this
  /// unit. A column of complex numbers becomes "real part of H", by the path H, and "imaginary
  /// part of H" behind all others. Time stamps become seconds since the first one, completed by a
  /// column of dates where they have none; columns without names and without cells at the end are
  /// left out.
  ForeignTable finish();

 private:
  enum class Kind { open, numbers, stamps, texts };

  struct Column {
    ForeignColumn column;
    Kind kind = Kind::open;
    std::vector<double> imaginary = {};  ///< up to the last complex cell; empty: none
    std::vector<std::optional<TimeStamp>> stamps = {};
    std::string first_stamp = {};
  };

  void add_cell(Column& column, std::string_view cell) const;
  void begin_texts(Column& column) const;
  void convert_stamps();
  void take_unit_of_cells(Column& column);
  void find_stray(ForeignColumn& column) const;
  std::vector<ForeignColumn> take_imaginary_parts();
  const Column* dates_for_clocks() const;

  std::vector<Column> columns_;
  std::vector<int> line_of_row_;
  std::vector<std::string> assumptions_;
  char decimal_;
};

}  // namespace flexarm::measured
