#include "compare/paper/paper_cells.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <tuple>

namespace flexarm::compare::paper {

namespace {

constexpr const char* kAverage = "average";

std::string name_of(const FrequencyCell& cell) {
  return fmt::format("{}, {}, {} {}", cell.method, cell.location, cell.feature, cell.order);
}

CellCheck check(int table, std::string cell, std::string unit, const PrintedNumber& printed,
                double recomputed) {
  return {.table = table,
          .cell = std::move(cell),
          .unit = std::move(unit),
          .printed = printed,
          .recomputed = recomputed,
          .follows = rounds_to(recomputed, printed)};
}

struct Mean {
  double sum = 0.0;
  int count = 0;
  double value() const { return sum / count; }
};

}  // namespace

std::vector<CellCheck> check_cells() {
  std::vector<CellCheck> checks;
  // By column of a table; the average stands behind the locations it is made of.
  std::map<std::tuple<int, std::string, std::string, int>, Mean> means;
  for (const auto& cell : tables().frequencies) {
    if (!cell.measured_Hz) continue;
    Mean& mean = means[{cell.table, cell.method, cell.feature, cell.order}];
    if (cell.location == kAverage) {
      checks.push_back(check(cell.table, name_of(cell), "Hz", *cell.measured_Hz, mean.value()));
    } else {
      mean.sum += cell.measured_Hz->value;
      ++mean.count;
    }
    const double analytical = cell.analytical_Hz.value;
    const double error = 100.0 * std::abs(cell.measured_Hz->value - analytical) / analytical;
    checks.push_back(check(cell.table, name_of(cell) + ": error", "%", *cell.error_percent, error));
  }
  std::map<int, Mean> damping;
  for (const auto& cell : tables().damping_ratios) {
    Mean& mean = damping[cell.order];
    if (cell.location == kAverage) {
      checks.push_back(check(5, fmt::format("{}, mode {}", cell.location, cell.order), "1",
                             cell.damping_ratio, mean.value()));
    } else {
      mean.sum += cell.damping_ratio.value;
      ++mean.count;
    }
  }
  return checks;
}

GridCount count_on_grid(double spacing_Hz) {
  GridCount count;
  for (const auto& cell : tables().frequencies) {
    if (cell.table == 4 || cell.location == kAverage || !cell.measured_Hz) continue;
    ++count.cells;
    const double nearest = spacing_Hz * std::round(cell.measured_Hz->value / spacing_Hz);
    if (rounds_to(nearest, *cell.measured_Hz)) {
      ++count.on_grid;
    } else {
      count.off_grid.push_back(fmt::format("Table {}, {}", cell.table, name_of(cell)));
    }
  }
  return count;
}

}  // namespace flexarm::compare::paper
