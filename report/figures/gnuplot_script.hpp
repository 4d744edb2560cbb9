#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/figure_layout.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

enum class FigureFormat { svg, pdf, png };

struct GnuplotScript {
  std::string text;
  /// What gnuplot's groups stand for, in their order: the series drawn, then the legend's lines.
  std::vector<std::string> group_names;
};

/// The gnuplot 5.4 commands and data that write `figure` to standard output. All text of
/// the figure is quoted so that gnuplot takes no part of it for markup, a variable or a command.
GnuplotScript gnuplot_script(const Figure& figure, const FigureLayout& layout,
                             FigureFormat format = FigureFormat::svg);

}  // namespace flexarm::report
