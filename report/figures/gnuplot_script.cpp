#include "report/figures/gnuplot_script.hpp"

#include "report/figures/text_size.hpp"
#include "report/figures/thinned_series.hpp"
#include "report/utf8_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

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

constexpr double kPixelsPerInch = 96.0;
constexpr double kLeastLegendMarker = 0.5;  // of markers too small to be seen alone

/// Of SVG in pixels, else in points.
double font_size(double size_px, FigureFormat format) {
  return format == FigureFormat::svg ? size_px : 0.75 * size_px;
}

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
std::string tick_commands(char axis_name, const Axis& axis, const std::vector<Tick>& ticks,
                          bool labelled) {
  std::string text =
      axis.scale == Scale::logarithmic ? fmt::format("set logscale {}\n", axis_name) : "";
  text += fmt::format("set {}tics (", axis_name);
  for (const Tick& tick : ticks) {
    // Level 0 is a full tick with its grid line, level 1 a short one.
    text += fmt::format("{}{} {} {}", &tick == &ticks.front() ? "" : ", ",
                        in_quotes(labelled ? tick.label : std::string()), tick.position,
                        tick.label.empty() ? 1 : 0);
  }
  return text + ")\n";
}

/// A label at `anchor`, moved by pixels to the right and up.
std::string label_command(const Figure& figure, std::string_view text, std::string_view anchor,
                          std::string_view alignment, double right_px, double up_px) {
  return fmt::format("set label {} at {} {} offset screen {},{}\n", in_quotes(text), anchor,
                     alignment, right_px / figure.width_px, up_px / figure.height_px);
}

/// Text beside a point, which gnuplot centres on it in height. On white, so that no line runs
/// through it; but for texts at the ends of curves.
std::string annotation_command(const Figure& figure, const Annotation& annotation,
                               const TextSize& size) {
  const auto label = [&](const char* alignment, double right_px, double up_px,
                         const char* ground = "boxed front") {
    return label_command(figure, annotation.text,
                         fmt::format("first {},{}", annotation.x, annotation.y),
                         fmt::format("{} {}", alignment, ground), right_px, up_px);
  };
  switch (annotation.place) {
    case TextPlace::above:
      return label("center", 0.0, size.above_px());
    case TextPlace::below:
      return label("center", 0.0, -size.above_px());
    case TextPlace::centre:
      return label("center", 0.0, 0.0);
    case TextPlace::left:
      return label("right", -size.beside_px(), 0.0);
    case TextPlace::right:
      return label("left", size.beside_px(), 0.0);
    case TextPlace::end:
      return label("left", size.beside_px(), 0.0, "front");
    case TextPlace::upper_right:
      break;
  }
  return label("left", 0.5 * size.font_px, 0.5 * size.font_px, "front");
}

/// Axes, ticks and texts of a panel.
std::string panel_frame(const Figure& figure, const PanelStack& stack, const Panel& panel,
                        const PanelBox& box, bool lowest) {
  const double width = figure.width_px;
  const double height = figure.height_px;
  std::string text = fmt::format(
      "reset\n"
      "unset key\n"
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
  text += tick_commands('x', x_axis, box.x_ticks, labelled);
  text += tick_commands('y', panel.y, box.y_ticks, true);
  // Labels at places of our own: gnuplot's depend on the format and on the widths of ticks.
  if (labelled && !box.x_label.empty()) {
    text +=
        label_command(figure, box.x_label, "graph 0.5,0", "center", 0.0, -3.2 * box.text.font_px);
  }
  if (!box.y_label.empty()) {
    text += label_command(figure, box.y_label, "graph 0,0.5", "center rotate", -box.label_px, 0.0);
  }
  if (!panel.title.empty()) {
    text +=
        label_command(figure, panel.title, "graph 0.5,1", "center", 0.0, 0.9 * box.text.font_px);
  }
  if (!box.note.empty()) {
    text += label_command(figure, box.note, "graph 1,1", "right", 0.0, 0.9 * box.text.font_px);
  }
  for (const Annotation& annotation : panel.annotations) {
    text += annotation_command(figure, annotation, box.text);
  }
  return text;
}

/// A sample of the legend, in pixels of the figure.
Series legend_sample(const PlacedLegendEntry& entry, const TextSize& size) {
  const double left = entry.left_px;
  const double right = left + kLegendSample_px;
  const double middle = entry.middle_px;
  Series sample{entry.text, {left, right}, {middle, middle}, *entry.style};
  if (sample.style.filled) {
    const double half = 0.3 * size.font_px;
    sample.y = {middle - half, middle - half};
    sample.y_to = {middle + half, middle + half};
  } else if (sample.style.marker != Marker::none) {
    sample.x = {left, 0.5 * (left + right), right};
    sample.y = {middle, middle, middle};
    if (sample.style.line == Line::none) sample.x = {sample.x[1]};
    if (sample.style.line == Line::none) sample.y = {middle};
    sample.style.marker_size = std::max(sample.style.marker_size, kLeastLegendMarker);
  }
  return sample;
}

/// Title and legend, drawn in pixels over the whole figure.
void append_furniture(GnuplotScript& script, const Figure& figure, const FigureLayout& layout,
                      FigureFormat format, std::size_t block) {
  const TextSize size{figure.font_size_px};
  script.text += fmt::format(
      "reset\nunset key\nunset border\nunset tics\n"
      "set lmargin at screen 0\nset rmargin at screen 1\n"
      "set bmargin at screen 0\nset tmargin at screen 1\n"
      "set xrange [0:{}]\nset yrange [0:{}]\n",
      figure.width_px, figure.height_px);
  if (!layout.title.empty()) {
    script.text += fmt::format("set label {} at {},{} center font ',{}'\n", in_quotes(layout.title),
                               0.5 * figure.width_px, layout.title_px,
                               font_size(size.of_title().font_px, format));
  }
  std::string plot = "plot NaN notitle";
  script.group_names.emplace_back("legend");
  for (const PlacedLegendEntry& entry : layout.legend) {
    const double left_px = entry.style ? entry.left_px + kLegendText_px : entry.left_px;
    script.text += fmt::format("set label {} at {},{} left\n", in_quotes(entry.text), left_px,
                               entry.middle_px);
    if (!entry.style) continue;
    const Series sample = legend_sample(entry, size);
    ++block;
    append_data(script.text, block, sample, {}, {});
    plot += fmt::format(", $data{} using {} {} notitle", block,
                        sample.style.filled ? "1:2:3" : "1:2", drawing(sample.style));
    std::string name = entry.text;
    std::ranges::replace(name, '\n', ' ');  // it is in lines
    script.group_names.push_back(std::move(name));
  }
  script.text += plot + "\n";
}

/// Its sizes in pixels, of 96 an inch. PNG has two pixels for each. The factors of markers and
/// dashes give the three formats one look.
std::string terminal(const Figure& figure, FigureFormat format) {
  const double size = font_size(figure.font_size_px, format);
  switch (format) {
    case FigureFormat::svg:
      break;
    case FigureFormat::pdf:
      return fmt::format(
          "set terminal pdfcairo size {}in,{}in noenhanced font '{},{}' fontscale 0.75 "
          "linewidth 1.5 pointscale 1.25 dashlength 2 background '#ffffff'\n",
          figure.width_px / kPixelsPerInch, figure.height_px / kPixelsPerInch, figure.font, size);
    case FigureFormat::png:
      return fmt::format(
          "set terminal pngcairo size {},{} noenhanced font '{},{}' fontscale 2 linewidth 2 "
          "pointscale 3.2 dashlength 2 background '#ffffff'\n",
          2 * figure.width_px, 2 * figure.height_px, figure.font, size);
  }
  return fmt::format("set terminal svg size {},{} noenhanced font '{},{}' background '#ffffff'\n",
                     figure.width_px, figure.height_px, figure.font, size);
}

}  // namespace

GnuplotScript gnuplot_script(const Figure& figure, const FigureLayout& layout,
                             FigureFormat format) {
  GnuplotScript script;
  script.text = "set encoding utf8\n" + terminal(figure, format) + "set multiplot\n";
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
  append_furniture(script, figure, layout, format, block);
  script.text += "unset multiplot\n";
  return script;
}

}  // namespace flexarm::report
