#include "report/figures/panel_ranges.hpp"

#include "report/figures/robust_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace flexarm::report {
namespace {

constexpr double kDataMargin = 0.04;  // of an axis, so that no curve runs along its edge

/// Values that differ by less, relatively, are one: the labels at an axis have six digits.
constexpr double kOneValue = 1e-6;

/// The smallest range, on the axis' scale, that holds all that was taken in.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take_in(double value, const Axis& axis) {
    low = std::min(low, on_scale(value, axis));
    high = std::max(high, on_scale(value, axis));
  }
};

Range range_of(const Extent& extent, const Axis& axis, double margin) {
  double low = extent.low;
  double high = extent.high;
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= kOneValue * size) {  // some room around it
    const double room = size == 0.0 || axis.scale == Scale::logarithmic ? 0.5 : size / 2;
    low -= room;
    high += room;
  }
  const double margin_width = margin * (high - low);
  const Range range{axis.minimum.value_or(from_scale(low - margin_width, axis)),
                    axis.maximum.value_or(from_scale(high + margin_width, axis))};
  if (!(range.from < range.to) || !is_drawable(range.from, axis) || !is_drawable(range.to, axis)) {
    throw std::invalid_argument(
        fmt::format("axis \"{}\": {} to {} is no range", axis.label, range.from, range.to));
  }
  return range;
}

/// Takes the drawable points of a panel into both extents.
void take_in(const Panel& panel, const Axis& x_axis, Extent& x, Extent& y) {
  bool anything = false;
  for (const Series& series : panel.series) {
    if (series.x.empty() || series.x.size() != series.y.size()) {
      throw std::invalid_argument(fmt::format("series \"{}\": {} values of x and {} of y",
                                              series.name, series.x.size(), series.y.size()));
    }
    if (series.style.filled && series.y_to.size() != series.y.size()) {
      throw std::invalid_argument(fmt::format("series \"{}\": {} values of y and {} to fill up to",
                                              series.name, series.y.size(), series.y_to.size()));
    }
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!is_drawable(series, i, x_axis, panel.y)) continue;
      x.take_in(series.x[i], x_axis);
      y.take_in(series.y[i], panel.y);
      if (series.style.filled) y.take_in(series.y_to[i], panel.y);
      anything = true;
    }
  }
  if (!anything) {
    throw std::invalid_argument(
        fmt::format("panel \"{}\": no series has a point to draw", panel.y.label));
  }
}

std::string signed_text(double value) {
  return fmt::format("{}{:.3g}", value < 0.0 ? "−" : "", std::abs(value));
}

/// Leaves outliers out of the extent and says how many there are.
std::string leave_out_outliers(const Panel& panel, const Axis& x_axis, Extent& y) {
  std::vector<double> values;
  for (const Series& series : panel.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!is_drawable(series, i, x_axis, panel.y)) continue;
      values.push_back(on_scale(series.y[i], panel.y));
      if (series.style.filled) values.push_back(on_scale(series.y_to[i], panel.y));
    }
  }
  const std::size_t count = values.size();
  const RobustRange robust = robust_range(std::move(values));
  if (robust.outside == 0) return "";
  std::string extremes;
  if (y.low < robust.low) extremes = signed_text(from_scale(y.low, panel.y));
  if (y.high > robust.high) {
    extremes += (extremes.empty() ? "" : " and ") + signed_text(from_scale(y.high, panel.y));
  }
  y = {robust.low, robust.high};
  return fmt::format("{} of {} points outside, up to {}", robust.outside, count, extremes);
}

}  // namespace

StackRanges ranges_of(const PanelStack& stack) {
  StackRanges made;
  Extent shared_x;
  for (const Panel& panel : stack.panels) {
    const Axis& x_axis = panel.x ? *panel.x : stack.x;
    Extent own_x;
    Extent y;
    take_in(panel, x_axis, panel.x ? own_x : shared_x, y);
    made.notes.push_back(panel.y.robust ? leave_out_outliers(panel, x_axis, y) : "");
    made.x.push_back(panel.x ? range_of(own_x, x_axis, kDataMargin / 2) : Range{});
    made.y.push_back(range_of(y, panel.y, kDataMargin));
  }
  for (std::size_t i = 0; i < stack.panels.size(); ++i) {
    if (!stack.panels[i].x) made.x[i] = range_of(shared_x, stack.x, kDataMargin / 2);
  }
  return made;
}

bool is_shown(const Series& series, const Axis& x_axis, const Axis& y_axis, const Range& x,
              const Range& y) {
  int below = 0;
  int above = 0;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!is_drawable(series, i, x_axis, y_axis)) continue;
    if (!(series.x[i] >= x.from && series.x[i] <= x.to)) continue;
    const double low = series.style.filled ? std::min(series.y[i], series.y_to[i]) : series.y[i];
    const double high = series.style.filled ? std::max(series.y[i], series.y_to[i]) : series.y[i];
    if (high >= y.from && low <= y.to) return true;
    ++(high < y.from ? below : above);
  }
  // A line from below to above passes through.
  return series.style.line != Line::none && below > 0 && above > 0;
}

}  // namespace flexarm::report
