#include "report/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::report {

Column error_column(std::string name, std::string unit) {
  return {std::move(name), std::move(unit), 2, Notation::scientific};
}

Column qualifying(std::string name, std::string unit, int significant_digits) {
  return {std::move(name), std::move(unit), significant_digits, Notation::general, true};
}

void Table::add_row(std::vector<Cell> row) {
  if (row.size() != columns.size()) {
    throw std::invalid_argument(fmt::format("table \"{}\": a row of {} cells under {} columns",
                                            caption, row.size(), columns.size()));
  }
  rows.push_back(std::move(row));
}

double explained_share(double share) {
  return std::clamp(share, 0.0, 1.0);
}

double explained_percent(double share) {
  return 100.0 * explained_share(share);
}

bool is_missing(const Cell& cell) {
  const double* number = std::get_if<double>(&cell);
  return std::holds_alternative<std::monostate>(cell) || (number != nullptr && std::isnan(*number));
}

}  // namespace flexarm::report
