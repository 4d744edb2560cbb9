#include "report/figures/figure_layout.hpp"

#include "report/utf8_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace flexarm::report {
namespace {

constexpr double kCharacter_px = 0.6 * kFontSize_px;  // mean advance of a broad sans-serif face
constexpr double kLine_px = 1.45 * kFontSize_px;
constexpr double kEdge_px = 16.0;
constexpr double kTitle_px = 44.0;
constexpr double kPanelTitle_px = 24.0;
constexpr double kPanelGap_px = 14.0;
constexpr double kAxisLabel_px = 56.0;  // tick labels and axis label under a stack
constexpr double kTickNumber_px = 7.0 * kCharacter_px;
constexpr double kLegendSample_px = 54.0;
constexpr double kLegendGap_px = 14.0;
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

std::vector<LegendEntry> legend_of(const Figure& figure) {
  if (!figure.legend.empty()) return figure.legend;
  std::vector<LegendEntry> legend;
  for (const PanelStack& stack : figure.stacks) {
    for (const Panel& panel : stack.panels) {
      for (const Series& series : panel.series) {
        const auto has_name = [&](const LegendEntry& e) { return e.text == series.name; };
        if (!series.name.empty() && std::ranges::none_of(legend, has_name)) {
          legend.push_back({series.name, series.style});
        }
      }
    }
  }
  return legend;
}

/// Room on the left of a stack for its axis labels and tick labels.
double left_margin_px(const PanelStack& stack) {
  double widest_tick = kTickNumber_px;
  for (const Panel& panel : stack.panels) {
    for (const Tick& tick : panel.y.ticks)
      widest_tick = std::max(widest_tick, text_width_px(tick.label));
  }
  return kEdge_px + kLine_px + widest_tick;
}

/// Shares the height between `bottom_px` and `top_px` out among the panels, the first on top.
void stack_panels(const PanelStack& stack, double bottom_px, double top_px,
                  std::vector<PanelBox>& boxes) {
  const auto title_px = [&](std::size_t i) {
    return stack.panels[i].title.empty() ? 0.0 : kPanelTitle_px;
  };
  const auto gap_below_px = [&](std::size_t i) {
    return kPanelGap_px + (stack.panels[i].x ? kAxisLabel_px : 0.0);
  };
  const auto above_px = [&](std::size_t i) {
    return (i > 0 ? gap_below_px(i - 1) : 0.0) + title_px(i);
  };
  double room = top_px - bottom_px;
  double total_height = 0.0;
  for (std::size_t i = 0; i < stack.panels.size(); ++i) {
    room -= above_px(i);
    total_height += stack.panels[i].height;
  }
  // A blank panel takes what the last panel takes.
  const std::size_t last = stack.panels.size() - 1;
  room -= stack.blank_panels * (gap_below_px(last) + title_px(last));
  total_height += stack.blank_panels * stack.panels[last].height;

  double top = top_px;
  for (std::size_t i = 0; i < stack.panels.size(); ++i) {
    boxes[i].top_px = top -= above_px(i);
    boxes[i].bottom_px = top -= room * stack.panels[i].height / total_height;
  }
}

/// Shortens the longer sides, from below and from the right.
void make_square(PanelBox& box) {
  const double side = std::min(box.top_px - box.bottom_px, box.right_px - box.left_px);
  box.bottom_px = box.top_px - side;
  box.right_px = box.left_px + side;
}

}  // namespace

bool is_drawable(double value, const Axis& axis) {
  return std::isfinite(value) && (axis.scale == Scale::linear || value > 0.0);
}

bool is_drawable(const Series& series, std::size_t point, const Axis& x, const Axis& y) {
  return is_drawable(series.x[point], x) && is_drawable(series.y[point], y) &&
         (!series.style.filled || is_drawable(series.y_to[point], y));
}

double on_scale(double value, const Axis& axis) {
  return axis.scale == Scale::logarithmic ? std::log10(value) : value;
}

double from_scale(double value, const Axis& axis) {
  return axis.scale == Scale::logarithmic ? std::pow(10.0, value) : value;
}

double text_width_px(const std::string& text) {
  return kCharacter_px * static_cast<double>(display_width(text));
}

FigureLayout lay_out(const Figure& figure) {
  const bool has_panels =
      !figure.stacks.empty() &&
      std::ranges::all_of(figure.stacks, [](const auto& stack) { return !stack.panels.empty(); });
  if (!has_panels) {
    throw std::invalid_argument(fmt::format("figure \"{}\" has no panels", figure.title));
  }

  FigureLayout layout;
  layout.legend = legend_of(figure);
  const double top_px = figure.height_px - (figure.title.empty() ? kEdge_px : kTitle_px);
  const double bottom_px = kAxisLabel_px;

  layout.legend_rows = std::max(1, static_cast<int>((top_px - kEdge_px) / kLegendRow_px));
  double widest_entry = 0.0;
  for (const LegendEntry& entry : layout.legend) {
    widest_entry = std::max(widest_entry, text_width_px(entry.text));
  }
  const auto entries = static_cast<int>(layout.legend.size());
  const int legend_columns = (entries + layout.legend_rows - 1) / layout.legend_rows;
  layout.legend_left_px =
      figure.width_px - kEdge_px / 2 - legend_columns * (widest_entry + kLegendSample_px);
  layout.legend_top_px = top_px;

  double room = layout.legend_left_px - (entries > 0 ? kLegendGap_px : kEdge_px / 2);
  double total_width = 0.0;
  for (const PanelStack& stack : figure.stacks) {
    room -= left_margin_px(stack);
    total_width += stack.width;
  }
  double right = 0.0;
  for (const PanelStack& stack : figure.stacks) {
    const double left = right + left_margin_px(stack);
    right = left + room * stack.width / total_width;

    Extent shared_x;
    std::vector<PanelBox> boxes(stack.panels.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Panel& panel = stack.panels[i];
      Extent own_x;
      Extent y;
      take_in(panel, panel.x.value_or(stack.x), panel.x ? own_x : shared_x, y);
      if (panel.x) boxes[i].x = range_of(own_x, *panel.x, kDataMargin / 2);
      boxes[i].y = range_of(y, panel.y, kDataMargin);
      boxes[i].left_px = left;
      boxes[i].right_px = right;
      boxes[i].label_px = left_margin_px(stack) - kLine_px;
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!stack.panels[i].x) boxes[i].x = range_of(shared_x, stack.x, kDataMargin / 2);
    }
    stack_panels(stack, bottom_px, top_px, boxes);
    if (stack.square) std::ranges::for_each(boxes, make_square);
    layout.boxes.push_back(std::move(boxes));
  }
  return layout;
}

}  // namespace flexarm::report
