#include "report/figures/svg.hpp"

#include "report/figures/figure_layout.hpp"
#include "report/figures/gnuplot.hpp"
#include "report/figures/gnuplot_script.hpp"
#include "report/figures/label_placement.hpp"
#include "report/utf8_text.hpp"
#include "report/xml_text.hpp"

#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace flexarm::report {
namespace {

/// Replaces what stands from the next `opening` after `from` up to `closing`; returns the place
/// behind it, or npos when there is none.
std::size_t replace_between(std::string& svg, std::string_view opening, std::string_view closing,
                            std::string_view replacement, std::size_t from) {
  const std::size_t begin = svg.find(opening, from);
  if (begin == std::string::npos) return std::string::npos;
  const std::size_t end = svg.find(closing, begin);
  if (end == std::string::npos) return std::string::npos;
  svg.replace(begin, end + closing.size() - begin, replacement);
  return begin + replacement.size();
}

}  // namespace

std::string to_svg(Figure figure) {
  place_labels(figure);
  const GnuplotScript script = gnuplot_script(figure, lay_out(figure));
  std::string svg = run_gnuplot(script.text);
  if (!svg.ends_with("</svg>\n\n")) throw std::runtime_error("gnuplot left its SVG unfinished");
  svg.pop_back();

  // gnuplot states its version, which would make the bytes depend on it.
  replace_between(svg, "<title>Gnuplot</title>", "</desc>",
                  "<title>" + xml_escaped(printable(figure.title)) + "</title>", 0);
  std::size_t place = 0;
  for (const std::string& name : script.group_names) {
    place = replace_between(svg, "<title>gnuplot_plot_", "</title>",
                            "<title>" + xml_escaped(printable(name)) + "</title>", place);
    if (place == std::string::npos) throw std::runtime_error("gnuplot left out " + name);
  }
  return svg;
}

}  // namespace flexarm::report
