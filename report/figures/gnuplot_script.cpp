#include "report/figures/gnuplot_script.hpp"

#include "report/figures/logarithmic_ticks.hpp"
#include "report/figures/thinned_series.hpp"
#include "report/utf8_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>

namespace flexarm::report {
namespace {

struct Rgb {
  int red, green, blue;
};

/// [OkabeIto2008], without the yellow that is lost on white.
constexpr std::array<Rgb, kColours> kPalette{{{0, 0, 0},
                                              {0, 114, 178},
                                              {213, 94, 0},
                                              {0, 158, 115},
                                              {204, 121, 167},
                                              {230, 159, 0},
                                              {86, 180, 233},
                                              {128, 128, 128}}};

constexpr double kLegendSpacing = kLegendRow_px / (1.5 * kFontSize_px);  // gnuplot's unit of rows
constexpr double kPixelsPerTickLabel = 26.0;  // at least, along a vertical axis

std::string hex_colour(const Style& style) {
  const Rgb rgb = kPalette[static_cast<std::size_t>(style.colour) % kPalette.size()];
  const auto tinted = [&](int part) {
    return static_cast<int>(std::lround(part + (255 - part) * style.tint));
  };
  return fmt::format("'#{:02x}{:02x}{:02x}'", tinted(rgb.red), tinted(rgb.green), tinted(rgb.blue));
}

/// A gnuplot string. Nothing is special between single quotes but the quote itself, which is
/// doubled; a line feed is joined in from a double-quoted string.
std::string in_quotes(std::string_view text) {
  std::string string = "'";
  for (const char c : printable(text)) {
    if (c == '\n') {
      string += "'.\"\\n\".'";
    } else {
      string += c;
      if (c == '\'') string += c;
    }
  }
  return string + "'";
}

std::string axis_text(const Axis& axis) {
  return axis.unit.empty() ? axis.label : fmt::format("{} [{}]", axis.label, axis.unit);
}

/// "with lines ..." for a series or a line of the legend.
std::string drawing(const Style& style) {
  if (style.filled) {
    return fmt::format("with filledcurves fillcolor rgb {} fillstyle solid 1 noborder",
                       hex_colour(style));
  }
  const bool has_line = style.line != Line::none;
  const bool has_marker = style.marker != Marker::none;
  std::string text =
      fmt::format("with {} linecolor rgb {} linewidth {}",
                  has_line && has_marker ? "linespoints" : (has_marker ? "points" : "lines"),
                  hex_colour(style), style.line_width_px);
  switch (style.line) {
    case Line::none:
    case Line::solid:
      break;
    case Line::dashed:
      text += " dashtype (8,5)";
      break;
    case Line::dotted:
      text += " dashtype (2,4)";
      break;
    case Line::dash_dotted:
      text += " dashtype (10,4,2,4)";
      break;
  }
  if (has_marker) {  // the enumeration has gnuplot's order of point types
    text += fmt::format(" pointtype {} pointsize {}", static_cast<int>(style.marker),
                        style.marker_size);
  }
  return text;
}

/// The points as a named data block; a blank line breaks the curve. False: no point is drawable.
bool append_data(std::string& script, std::size_t block, const Series& series, const Axis& x,
                 const Axis& y) {
  fmt::format_to(std::back_inserter(script), "$data{} << EOD\n", block);
  bool gap = true;
  bool anything = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (is_drawable(series, i, x, y)) {
      if (gap && anything) script += '\n';
      fmt::format_to(std::back_inserter(script), "{} {}", series.x[i], series.y[i]);
      if (series.style.filled) fmt::format_to(std::back_inserter(script), " {}", series.y_to[i]);
      script += '\n';
      gap = false;
      anything = true;
    } else {
      gap = true;
    }
  }
  script += "EOD\n";
  return anything;
}

/// Ticks of one axis; `labelled` is false for the panels of a stack above the lowest.
std::string tick_commands(char axis_name, const Axis& axis, const Range& range, double length_px,
                          bool labelled) {
  const bool logarithmic = axis.scale == Scale::logarithmic;
  std::string text = logarithmic ? fmt::format("set logscale {}\n", axis_name) : "";
  if (axis.ticks.empty() && !logarithmic) {
    return labelled ? text : text + fmt::format("set format {} ''\n", axis_name);
  }
  const std::vector<Tick> ticks =
      axis.ticks.empty()
          ? logarithmic_ticks(range, static_cast<int>(length_px / kPixelsPerTickLabel))
          : axis.ticks;
  text += fmt::format("set {}tics (", axis_name);
  for (const Tick& tick : ticks) {
    // Level 0 is a full tick with its grid line, level 1 a short one.
    text += fmt::format("{}{} {} {}", &tick == &ticks.front() ? "" : ", ",
                        in_quotes(labelled ? tick.label : std::string()), tick.position,
                        tick.label.empty() ? 1 : 0);
  }
  return text + ")\n";
}

/// Alignment and offset of a text, which gnuplot centres on its point in height. On white, so that
/// no line runs through it; but for texts at the ends of curves.
std::string placing(TextPlace place, const Figure& figure) {
  const auto shifted = [&](const char* alignment, double right_px, double up_px) {
    return fmt::format("{} offset screen {},{} boxed", alignment, right_px / figure.width_px,
                       up_px / figure.height_px);
  };
  switch (place) {
    case TextPlace::upper_right:
      break;
    case TextPlace::above:
      return shifted("center", 0.0, kTextAbove_px);
    case TextPlace::below:
      return shifted("center", 0.0, -kTextAbove_px);
    case TextPlace::centre:
      return shifted("center", 0.0, 0.0);
    case TextPlace::left:
      return shifted("right", -kTextBeside_px, 0.0);
    case TextPlace::right:
      return shifted("left", kTextBeside_px, 0.0);
  }
  return "left offset 0.5,0.5";
}

std::string panel_frame(const Figure& figure, const PanelStack& stack, const Panel& panel,
                        const PanelBox& box, bool lowest) {
  const double width = figure.width_px;
  const double height = figure.height_px;
  std::string text = fmt::format(
      "reset\n"
      "unset key\n"
      "set minussign\n"
      "set style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.3,0.3\n"
      "set border 3 linecolor rgb '#555555' linewidth 0.8\n"
      "set tics nomirror out scale 0.5,0.25 textcolor rgb '#222222'\n"
      "set grid xtics ytics linetype 1 linecolor rgb '#e2e2e2' linewidth 0.8\n"
      "set lmargin at screen {}\nset rmargin at screen {}\n"
      "set bmargin at screen {}\nset tmargin at screen {}\n"
      "set xrange [{}:{}]\nset yrange [{}:{}]\n",
      box.left_px / width, box.right_px / width, box.bottom_px / height, box.top_px / height,
      box.x.from, box.x.to, box.y.from, box.y.to);
  const Axis& x_axis = panel.x ? *panel.x : stack.x;
  const bool labelled = lowest || panel.x;
  text += tick_commands('x', x_axis, box.x, box.right_px - box.left_px, labelled);
  text += tick_commands('y', panel.y, box.y, box.top_px - box.bottom_px, true);
  if (labelled) text += fmt::format("set xlabel {} offset 0,0.5\n", in_quotes(axis_text(x_axis)));
  // A label in place of ylabel, which stands elsewhere in each panel with the width of its ticks.
  text += fmt::format("set label {} at graph 0,0.5 center rotate offset screen {},0\n",
                      in_quotes(axis_text(panel.y)), -box.label_px / width);
  if (!panel.title.empty()) {
    text += fmt::format("set title {} offset 0,-0.5\n", in_quotes(panel.title));
  }
  for (const Annotation& a : panel.annotations) {
    text += fmt::format("set label {} at first {},{} {} front\n", in_quotes(a.text), a.x, a.y,
                        placing(a.place, figure));
  }
  return text;
}

void append_legend(GnuplotScript& script, const Figure& figure, const FigureLayout& layout) {
  script.text += fmt::format(
      "reset\n"
      "set margins 0,0,0,0\nunset border\nunset tics\nset xrange [0:1]\nset yrange [0:1]\n"
      "set key at screen {},{} left top Left reverse vertical maxrows {} samplen 2.2 "
      "spacing {}\n"
      "plot NaN notitle",
      layout.legend_left_px / figure.width_px, layout.legend_top_px / figure.height_px,
      layout.legend_rows, kLegendSpacing);
  script.group_names.emplace_back("legend");
  for (const LegendEntry& entry : layout.legend) {
    script.text += fmt::format(", keyentry {} title {}", entry.style ? drawing(*entry.style) : "",
                               in_quotes(entry.text));
    script.group_names.push_back(entry.text);
  }
  script.text += "\n";
}

}  // namespace

GnuplotScript gnuplot_script(const Figure& figure, const FigureLayout& layout) {
  GnuplotScript script;
  script.text = fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} noenhanced font 'sans-serif,{}' background '#ffffff'\n"
      "set multiplot title {} font ',{}'\n",
      figure.width_px, figure.height_px, kFontSize_px, in_quotes(figure.title), kFontSize_px + 3);
  std::size_t block = 0;
  for (std::size_t s = 0; s < figure.stacks.size(); ++s) {
    const PanelStack& stack = figure.stacks[s];
    for (std::size_t p = 0; p < stack.panels.size(); ++p) {
      const Panel& panel = stack.panels[p];
      const bool lowest = p + 1 == stack.panels.size();
      script.text += panel_frame(figure, stack, panel, layout.boxes[s][p], lowest);
      std::string plot;
      for (const Series& series : panel.series) {
        ++block;
        const Axis& x_axis = panel.x ? *panel.x : stack.x;
        const PanelBox& box = layout.boxes[s][p];
        const Series shown = thinned(series, x_axis, panel.y, box.x, box.right_px - box.left_px);
        if (!append_data(script.text, block, shown, x_axis, panel.y)) continue;
        plot += fmt::format("{}$data{} using {} {} notitle", plot.empty() ? "plot " : ", ", block,
                            series.style.filled ? "1:2:3" : "1:2", drawing(series.style));
        script.group_names.push_back(series.name);
      }
      script.text += plot + "\n";
    }
  }
  if (!layout.legend.empty()) append_legend(script, figure, layout);
  script.text += "unset multiplot\n";
  return script;
}

}  // namespace flexarm::report
