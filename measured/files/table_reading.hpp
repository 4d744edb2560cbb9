#pragma once

#include "measured/files/delimited_line.hpp"
#include "measured/files/text_lines.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace flexarm::measured {

/// A row has two numbers or more: time and something measured.
inline constexpr std::size_t kFewestNumbers = 2;

/// A way to read the sample, and how much of it becomes numbers.
struct TableReading {
  Dialect dialect;
  std::size_t cells = 0;    ///< of a row
  std::size_t whole = 0;    ///< rows of numbers alone
  std::size_t numbers = 0;  ///< in all rows

  std::pair<std::size_t, std::size_t> score() const { return {whole, numbers}; }
};

/// Numbers, complex ones too, and time stamps among the cells.
std::size_t count_numbers(std::span<const std::string_view> cells, char decimal);

/// The separator and the decimal mark that make most cells of the lines numbers.
TableReading best_table_reading(std::span<const TextLine> sample);

}  // namespace flexarm::measured
