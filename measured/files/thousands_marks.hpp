#pragma once

#include "measured/files/delimited_line.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// A cell whose decimal mark may be a thousands separator.
struct DoubtfulMark {
  std::size_t column = 0;
  int line = 0;
  std::string cell;
  std::string fault;  ///< "has thousands separators; ..." or both readings
};

/// Tells thousands separators from decimal marks in tables where all numbers are whole: 1,032
/// beside 987. Such a mark has one to three digits in front, the first no zero, and three behind.
class ThousandsMarks {
 public:
  ThousandsMarks(std::size_t columns, Dialect dialect) : dialect_(dialect), uses_(columns) {}

  /// Takes a row into account.
  void add_row(std::span<const std::string_view> cells, int line);

  /// The first cell of a column that has such marks alone, if no mark in the table is surely a
  /// decimal one. They are surely thousands separators where whole numbers without a mark stand
  /// beside them and one ends in 0: what leaves out ",000" leaves out the last zeros of decimals.
  /// Numbers from 1000 on without a mark, and exponents, speak for decimals.
  std::optional<DoubtfulMark> doubtful() const;

 private:
  struct Use {
    std::string first;  ///< cell with such a mark
    int line = 0;
    bool has_whole = false;     ///< up to 999
    bool is_ungrouped = false;  ///< a whole number from 1000 on, or an exponent
    bool ends_in_zero = false;  ///< some cell with a mark
  };

  Dialect dialect_;
  bool has_decimals_ = false;
  std::vector<Use> uses_;
};

}  // namespace flexarm::measured
