#pragma once

#include "measured/files/atomic_file.hpp"
#include "report/figures/axis_units.hpp"
#include "report/figures/figure.hpp"
#include "report/figures/gnuplot_script.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::report {

struct FigureSize {
  int width_px = 0;
  int height_px = 0;
};

/// How figures are drawn. Pixels are 1/96 inch; PNG has two for each.
struct FigureOptions {
  std::vector<FigureFormat> formats = {FigureFormat::svg};
  std::optional<FigureSize> size = {};  ///< empty: each figure's own
  std::string font = kSansSerif;        ///< family; PDF embeds it, PNG has it drawn
  double font_size_px = kFontSize_px;
  MagnitudeScale magnitude = MagnitudeScale::absolute;  ///< of all Bode diagrams
  FrequencyUnit frequency = FrequencyUnit::hertz;       ///< of all axes of frequencies
};

/// "svg".
std::string_view to_string(FigureFormat format);

/// The figure with the options' units, font and size, enlarged where a panel would be less than
/// four lines of text high or fourteen characters wide.
Figure with_options(Figure figure, const FigureOptions& options);

/// A document in that format, drawn by gnuplot. Throws std::invalid_argument as `lay_out` does, and
/// as `run_gnuplot` does.
std::string drawn(Figure figure, FigureFormat format);

/// A file for each figure and format, "NAME.svg", in the order of the figures; drawn on all cores.
/// Throws as `drawn` does.
std::vector<measured::NamedContent> figure_files(const std::vector<NamedFigure>& figures,
                                                 const FigureOptions& options = {});

}  // namespace flexarm::report
