#include "compare/assignment.hpp"

#include <limits>

namespace flexarm::compare {

std::vector<std::size_t> cheapest_assignment(std::span<const double> cost, std::size_t n) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t none = n;
  // Column n is where each row starts. Dual prices keep reduced costs at 0 or more.
  std::vector<double> row_price(n + 1, 0.0);
  std::vector<double> column_price(n + 1, 0.0);
  std::vector<std::size_t> row_of(n + 1, none);
  for (std::size_t start = 0; start < n; ++start) {
    std::vector<double> distance(n, kInfinity);
    std::vector<std::size_t> before(n, none);
    std::vector<bool> reached(n + 1, false);
    row_of[n] = start;
    std::size_t column = n;
    do {
      reached[column] = true;
      const std::size_t row = row_of[column];
      double step = kInfinity;
      std::size_t next = none;
      for (std::size_t j = 0; j < n; ++j) {
        if (reached[j]) continue;
        const double reduced = cost[row * n + j] - row_price[row] - column_price[j];
        if (reduced < distance[j]) {
          distance[j] = reduced;
          before[j] = column;
        }
        if (distance[j] < step) {
          step = distance[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= n; ++j) {
        if (reached[j]) {
          row_price[row_of[j]] += step;
          column_price[j] -= step;
        } else {
          distance[j] -= step;
        }
      }
      column = next;
    } while (row_of[column] != none);
    while (column != n) {
      row_of[column] = row_of[before[column]];
      column = before[column];
    }
    row_of[n] = none;
  }
  std::vector<std::size_t> column_of(n);
  for (std::size_t j = 0; j < n; ++j) column_of[row_of[j]] = j;
  return column_of;
}

}  // namespace flexarm::compare
