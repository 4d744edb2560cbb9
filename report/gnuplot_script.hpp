#pragma once

#include "report/figure.hpp"
#include "report/figure_layout.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

struct GnuplotScript {
  std::string text;
  std::vector<std::string> series_names;  ///< of the series drawn, in the order of drawing
};

/// The gnuplot 5.4 commands and data that write `figure` as SVG to standard output. All text of
/// the figure is quoted so that gnuplot takes no part of it for markup, a variable or a command.
GnuplotScript gnuplot_script(const Figure& figure, const FigureLayout& layout);

}  // namespace flexarm::report
