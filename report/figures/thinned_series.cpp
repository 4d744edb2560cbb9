#include "report/figures/thinned_series.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace flexarm::report {
namespace {

constexpr double kMarkerColumn_px = 3.0;  // about half a marker
constexpr std::size_t kFew = 4;           // points of a column, or a column on average

/// Indices of a column's points that are kept, ascending.
std::vector<std::size_t> kept_of(const Series& series, const std::vector<std::size_t>& column) {
  if (column.size() <= kFew) return column;
  std::vector<std::size_t> kept = {column.front(), column.back()};
  const auto add_extremes = [&](const std::vector<double>& values) {
    const auto [least, largest] =
        std::ranges::minmax_element(column, {}, [&](std::size_t i) { return values[i]; });
    kept.push_back(*least);
    kept.push_back(*largest);
  };
  add_extremes(series.y);
  if (series.style.filled) add_extremes(series.y_to);
  std::ranges::sort(kept);
  kept.erase(std::ranges::unique(kept).begin(), kept.end());
  return kept;
}

}  // namespace

Series thinned(const Series& series, const Axis& x, const Axis& y, const Range& range,
               double width_px) {
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (is_drawable(series, i, x, y)) drawn.push_back(i);
  }
  const bool markers = series.style.line == Line::none && !series.style.filled;
  const double columns = width_px / (markers ? kMarkerColumn_px : 1.0);
  const auto at = [&](std::size_t i) { return series.x[i]; };
  if (static_cast<double>(drawn.size()) <= kFew * columns ||
      !std::ranges::is_sorted(drawn, {}, at)) {
    return series;
  }
  const double from = on_scale(range.from, x);
  const double scale = columns / (on_scale(range.to, x) - from);
  Series shown{series.name, {}, {}, series.style};
  std::size_t last = drawn.front();
  const auto keep = [&](std::size_t i, bool gap) {
    shown.x.push_back(series.x[i]);
    shown.y.push_back(gap ? std::numeric_limits<double>::quiet_NaN() : series.y[i]);
    if (series.style.filled) shown.y_to.push_back(series.y_to[i]);
  };
  std::size_t place = 0;  // of `last` in `drawn`
  std::size_t begin = 0;
  while (begin < drawn.size()) {
    // What lies outside the panel is one column a side.
    const auto column_of = [&](std::size_t i) {
      return std::clamp(std::floor(scale * (on_scale(series.x[i], x) - from)), -1.0, columns);
    };
    std::size_t end = begin + 1;
    while (end < drawn.size() && column_of(drawn[end]) == column_of(drawn[begin])) ++end;
    const std::vector<std::size_t> column(drawn.begin() + static_cast<std::ptrdiff_t>(begin),
                                          drawn.begin() + static_cast<std::ptrdiff_t>(end));
    for (const std::size_t i : kept_of(series, column)) {
      std::size_t next = place;
      while (drawn[next] != i) ++next;
      // Between two neighbours in `drawn` nothing is missing in the series either.
      if (i - last != next - place) keep(i, true);
      keep(i, false);
      last = i;
      place = next;
    }
    begin = end;
  }
  return shown;
}

}  // namespace flexarm::report
