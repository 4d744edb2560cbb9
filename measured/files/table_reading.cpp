#include "measured/files/table_reading.hpp"

#include "measured/files/time_stamp.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace flexarm::measured {

namespace {

using std::string_view;

/// In the order preferred where two make the same cells numbers.
constexpr std::array<Dialect, 8> kDialects = {{{'\t', '.'},
                                               {'\t', ','},
                                               {';', '.'},
                                               {';', ','},
                                               {',', '.'},
                                               {',', ','},
                                               {' ', '.'},
                                               {' ', ','}}};

TableReading read_sample(std::span<const TextLine> sample, const Dialect& dialect) {
  std::map<std::size_t, TableReading> by_cells;
  LineSplitter splitter(dialect.separator);
  for (const auto& line : sample) {
    const auto cells = splitter.split(line.text);
    const std::size_t numbers = count_numbers(cells, dialect.decimal);
    if (numbers < kFewestNumbers) continue;
    TableReading& reading = by_cells[cells.size()];
    reading.cells = cells.size();
    const auto empty = static_cast<std::size_t>(std::ranges::count(cells, string_view()));
    reading.whole += numbers + empty == cells.size() ? 1U : 0U;
    reading.numbers += numbers;
  }
  TableReading best{dialect};
  for (auto& [cells, reading] : by_cells) {
    reading.dialect = dialect;
    if (reading.score() > best.score()) best = reading;
  }
  return best;
}

}  // namespace

std::size_t count_numbers(std::span<const string_view> cells, char decimal) {
  return static_cast<std::size_t>(std::ranges::count_if(cells, [&](string_view cell) {
    if (parse_cell(cell, decimal)) return true;
    const auto stamp = parse_time_stamp(cell);
    return (stamp && stamp->clock_ns) || parse_complex_cell(cell, decimal, true);
  }));
}

TableReading best_table_reading(std::span<const TextLine> sample) {
  TableReading best;
  for (const auto& dialect : kDialects) {
    const TableReading reading = read_sample(sample, dialect);
    if (reading.score() > best.score()) best = reading;
  }
  return best;
}

}  // namespace flexarm::measured
