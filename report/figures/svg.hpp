#pragma once

#include "report/figures/figure.hpp"

#include <string>

namespace flexarm::report {

/// The figure as an SVG document, drawn by gnuplot. The same figure gives the same bytes; a viewer
/// shows a series' name when the pointer is on it. Throws std::invalid_argument as `lay_out` does,
/// and std::runtime_error as `run_gnuplot` does.
std::string to_svg(Figure figure);

}  // namespace flexarm::report
