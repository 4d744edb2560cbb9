#include "report/figures/figure_files.hpp"

#include "report/figures/figure_layout.hpp"
#include "report/figures/gnuplot.hpp"
#include "report/figures/label_placement.hpp"
#include "report/figures/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tbb/parallel_for.h>
#include <utility>

namespace flexarm::report {
namespace {

constexpr double kLeastHeight = 4.0;  // of a panel, in lines
constexpr double kLeastWidth = 14.0;  // in characters
constexpr int kPasses = 3;            // the legend takes its share of each enlargement

/// Pixels that the lowest panel of a stack lacks, times the panels that it shares them with.
double missing_height_px(const PanelStack& stack, const std::vector<PanelBox>& boxes) {
  double lowest = stack.panels.front().height;
  double total = stack.blank_panels * stack.panels.back().height;
  for (const Panel& panel : stack.panels) {
    lowest = std::min(lowest, panel.height);
    total += panel.height;
  }
  const double unit_px =
      (boxes.front().top_px - boxes.front().bottom_px) / stack.panels.front().height;
  const double least_px = kLeastHeight * boxes.front().text.line_px();
  return std::max(0.0, (least_px / lowest - unit_px) * total);
}

double missing_width_px(const PanelStack& stack, const PanelBox& box, double total_width) {
  const double least_px = kLeastWidth * box.text.character_px();
  return std::max(0.0, (least_px - (box.right_px - box.left_px)) / stack.width * total_width);
}

}  // namespace

std::string_view to_string(FigureFormat format) {
  switch (format) {
    case FigureFormat::svg:
      break;
    case FigureFormat::pdf:
      return "pdf";
    case FigureFormat::png:
      return "png";
  }
  return "svg";
}

Figure with_options(Figure figure, const FigureOptions& options) {
  figure = in_units(std::move(figure), options.magnitude, options.frequency);
  figure.font = options.font;
  figure.font_size_px = options.font_size_px;
  if (options.size) {
    figure.width_px = options.size->width_px;
    figure.height_px = options.size->height_px;
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    const FigureLayout layout = lay_out(figure);
    double total_width = 0.0;
    for (const PanelStack& stack : figure.stacks) total_width += stack.width;
    double height_px = 0.0;
    double width_px = 0.0;
    for (std::size_t s = 0; s < figure.stacks.size(); ++s) {
      const PanelStack& stack = figure.stacks[s];
      height_px = std::max(height_px, missing_height_px(stack, layout.boxes[s]));
      // A square panel is narrow where it is low.
      if (stack.square) continue;
      width_px = std::max(width_px, missing_width_px(stack, layout.boxes[s].front(), total_width));
    }
    if (height_px == 0.0 && width_px == 0.0) break;
    figure.height_px += static_cast<int>(std::ceil(height_px));
    figure.width_px += static_cast<int>(std::ceil(width_px));
  }
  return figure;
}

std::string drawn(Figure figure, FigureFormat format) {
  if (format == FigureFormat::svg) return to_svg(std::move(figure));
  place_labels(figure);
  return run_gnuplot(gnuplot_script(figure, lay_out(figure), format).text);
}

std::vector<measured::NamedContent> figure_files(const std::vector<NamedFigure>& figures,
                                                 const FigureOptions& options) {
  const std::size_t formats = options.formats.size();
  std::vector<measured::NamedContent> files(figures.size() * formats);
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    const NamedFigure& named = figures[i / formats];
    const FigureFormat format = options.formats[i % formats];
    files[i] = {fmt::format("{}.{}", named.name, to_string(format)),
                drawn(with_options(named.figure, options), format)};
  });
  return files;
}

}  // namespace flexarm::report
