#include "report/figures/figure_layout.hpp"

#include "report/figures/linear_ticks.hpp"
#include "report/figures/logarithmic_ticks.hpp"
#include "report/figures/panel_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace flexarm::report {
namespace {

constexpr double kEdge_px = 16.0;
constexpr double kPanelGap_px = 14.0;
constexpr double kTick_px = 12.0;  // from an axis to its labels, with some room behind them
constexpr double kLegendGap_px = 14.0;
constexpr double kWidestLegend = 0.3;  // of the figure, samples included
constexpr double kLegendRow = 1.2;     // lines from one entry to the next

/// Lengths of a figure that follow from its font.
struct Furniture {
  TextSize text;

  double title_px(const std::string& title) const {
    if (title.empty()) return kEdge_px;
    return 26.0 + text.of_title().line_px() * line_count(title);
  }
  double panel_title_px() const { return 1.8 * text.font_px; }
  double axis_label_px() const {
    return 4.2 * text.font_px;
  }  // tick labels and label below a stack
};

/// "label [unit]".
std::string axis_text(const Axis& axis, int exponent) {
  const std::string unit = scaled_unit(exponent, axis.unit);
  if (unit.empty()) return axis.label;
  return axis.label.empty() ? fmt::format("[{}]", unit) : fmt::format("{} [{}]", axis.label, unit);
}

/// The label of a vertical axis in lines that are as long as the panel is high.
std::string upright_text(const std::string& label, double height_px, const TextSize& text) {
  constexpr double kReach = 1.05;  // beyond the panel, into the gaps
  if (text.width_px(label) <= kReach * height_px) return label;
  const std::size_t unit = label.rfind(" [");
  if (unit == std::string::npos || unit == 0) return text.wrapped(label, kReach * height_px);
  return text.wrapped(label.substr(0, unit), kReach * height_px) + "\n" + label.substr(unit + 1);
}

std::vector<LegendEntry> legend_of(const Figure& figure, const std::vector<StackRanges>& ranges) {
  if (!figure.legend.empty()) return figure.legend;
  std::vector<LegendEntry> legend;
  for (std::size_t s = 0; s < figure.stacks.size(); ++s) {
    const PanelStack& stack = figure.stacks[s];
    for (std::size_t p = 0; p < stack.panels.size(); ++p) {
      const Panel& panel = stack.panels[p];
      for (const Series& series : panel.series) {
        const auto has_name = [&](const LegendEntry& e) { return e.text == series.name; };
        if (series.name.empty() || std::ranges::any_of(legend, has_name)) continue;
        if (is_shown(series, panel.x ? *panel.x : stack.x, panel.y, ranges[s].x[p],
                     ranges[s].y[p])) {
          legend.push_back({series.name, series.style});
        }
      }
    }
  }
  return legend;
}

/// Columns of legend entries from the top down. Returns the left side of the first.
double place_legend(const std::vector<LegendEntry>& entries, const Figure& figure, double top_px,
                    FigureLayout& layout) {
  const TextSize text{figure.font_size_px};
  const double most_px = kWidestLegend * figure.width_px - kLegendText_px;
  double widest_px = 0.0;
  for (const LegendEntry& entry : entries) {
    layout.legend.push_back({text.wrapped(entry.text, most_px), entry.style});
    widest_px = std::max(widest_px, text.width_px(layout.legend.back().text));
  }
  const double column_px = kLegendText_px + widest_px + kLegendGap_px;
  const double first_px = top_px - 0.5 * text.line_px();
  int column = 0;
  double middle_px = first_px;
  for (PlacedLegendEntry& entry : layout.legend) {
    const double last_px = middle_px - (line_count(entry.text) - 1) * text.line_px();
    if (last_px < kEdge_px && middle_px < first_px) {
      ++column;
      middle_px = first_px;
    }
    entry.left_px = column * column_px;
    entry.middle_px = middle_px;
    middle_px -= (line_count(entry.text) - 1 + kLegendRow) * text.line_px();
  }
  if (layout.legend.empty()) return figure.width_px - kEdge_px / 2;
  const double left_px = figure.width_px - (column + 1) * column_px;
  for (PlacedLegendEntry& entry : layout.legend) entry.left_px += left_px;
  return left_px;
}

/// Shares the height between `bottom_px` and `top_px` out among the panels, the first on top.
void stack_panels(const PanelStack& stack, const Furniture& furniture, double bottom_px,
                  double top_px, std::vector<PanelBox>& boxes) {
  const auto title_px = [&](std::size_t i) {
    const bool has_text = !stack.panels[i].title.empty() || !boxes[i].note.empty();
    return has_text ? furniture.panel_title_px() : 0.0;
  };
  const auto gap_below_px = [&](std::size_t i) {
    return kPanelGap_px + (stack.panels[i].x ? furniture.axis_label_px() : 0.0);
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

/// Ticks of an axis, and what its label has.
std::vector<Tick> ticks_of(const Axis& axis, const Range& range, double length_px,
                           const TextSize& text, bool upright, int& exponent) {
  exponent = 0;
  if (!axis.ticks.empty()) return axis.ticks;
  const double line_px = 1.7 * text.font_px;
  if (axis.scale == Scale::logarithmic) {
    const double label_px = upright ? line_px : 6.0 * text.character_px();
    return logarithmic_ticks(range, std::max(1, static_cast<int>(length_px / label_px)));
  }
  auto made = linear_ticks(range, length_px, [&](const std::string& label) {
    return upright ? line_px : text.width_px(label) + 2.0 * text.character_px();
  });
  exponent = made.exponent;
  return std::move(made.ticks);
}

/// Ticks and label of the vertical axes; room on the left of the stack for both.
double lay_out_upright(const PanelStack& stack, const TextSize& text,
                       std::vector<PanelBox>& boxes) {
  // Labels of a stack stand in one line, that of a panel with names as ticks by itself.
  double widest_number_px = 4.0 * text.character_px();
  std::vector<double> widest_px(boxes.size());
  int most_lines = 1;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    PanelBox& box = boxes[i];
    const double height_px = box.top_px - box.bottom_px;
    int exponent = 0;
    box.y_ticks = ticks_of(stack.panels[i].y, box.y, height_px, text, true, exponent);
    box.y_label = upright_text(axis_text(stack.panels[i].y, exponent), height_px, text);
    most_lines = std::max(most_lines, line_count(box.y_label));
    for (const Tick& tick : box.y_ticks) {
      widest_px[i] = std::max(widest_px[i], text.width_px(tick.label));
    }
    if (stack.panels[i].y.ticks.empty())
      widest_number_px = std::max(widest_number_px, widest_px[i]);
  }
  const double furniture_px = kEdge_px + most_lines * text.line_px() + kTick_px;
  double margin_px = 0.0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double own_px = furniture_px + std::max(widest_px[i], widest_number_px);
    boxes[i].label_px = own_px - kEdge_px / 2 - 0.5 * text.line_px();
    margin_px = std::max(margin_px, own_px);
  }
  return margin_px;
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

FigureLayout lay_out(const Figure& figure) {
  const bool has_panels =
      !figure.stacks.empty() &&
      std::ranges::all_of(figure.stacks, [](const auto& stack) { return !stack.panels.empty(); });
  if (!has_panels) {
    throw std::invalid_argument(fmt::format("figure \"{}\" has no panels", figure.title));
  }
  const Furniture furniture{{figure.font_size_px}};
  const TextSize& text = furniture.text;
  std::vector<StackRanges> ranges;
  for (const PanelStack& stack : figure.stacks) ranges.push_back(ranges_of(stack));

  FigureLayout layout;
  layout.title = text.of_title().wrapped(figure.title, figure.width_px - 2.0 * kEdge_px);
  layout.title_px = figure.height_px - kEdge_px - 0.5 * text.of_title().font_px;
  const double top_px = figure.height_px - furniture.title_px(layout.title);
  const double bottom_px = furniture.axis_label_px();
  const double legend_px = place_legend(legend_of(figure, ranges), figure, top_px, layout);

  double room = legend_px - (layout.legend.empty() ? 0.0 : kLegendGap_px);
  double total_width = 0.0;
  std::vector<double> margin_px;
  for (std::size_t s = 0; s < figure.stacks.size(); ++s) {
    const PanelStack& stack = figure.stacks[s];
    std::vector<PanelBox> boxes(stack.panels.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].text = text;
      boxes[i].x = ranges[s].x[i];
      boxes[i].y = ranges[s].y[i];
      const bool both = !stack.panels[i].note.empty() && !ranges[s].notes[i].empty();
      boxes[i].note = stack.panels[i].note + (both ? "; " : "") + ranges[s].notes[i];
    }
    stack_panels(stack, furniture, bottom_px, top_px, boxes);
    margin_px.push_back(lay_out_upright(stack, text, boxes));
    room -= margin_px.back();
    total_width += stack.width;
    layout.boxes.push_back(std::move(boxes));
  }
  double right = 0.0;
  for (std::size_t s = 0; s < figure.stacks.size(); ++s) {
    const PanelStack& stack = figure.stacks[s];
    const double left = right + margin_px[s];
    right = left + room * stack.width / total_width;
    for (std::size_t i = 0; i < layout.boxes[s].size(); ++i) {
      PanelBox& box = layout.boxes[s][i];
      box.left_px = left;
      box.right_px = right;
      if (stack.square) make_square(box);
      const Axis& axis = stack.panels[i].x ? *stack.panels[i].x : stack.x;
      int exponent = 0;
      box.x_ticks = ticks_of(axis, box.x, box.right_px - box.left_px, text, false, exponent);
      box.x_label = axis_text(axis, exponent);
    }
  }
  return layout;
}

}  // namespace flexarm::report
