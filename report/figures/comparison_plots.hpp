#pragma once

#include "compare/comparison.hpp"
#include "report/figures/figure.hpp"

#include <vector>

namespace flexarm::report {

/// The pictures of a comparison: error against degrees of freedom for each family, the same for the
/// bases of assumed_modes, a pole-zero map and a Bode diagram a sensor, and the mode shapes.
std::vector<NamedFigure> comparison_plots(const compare::Comparison& comparison);

}  // namespace flexarm::report
