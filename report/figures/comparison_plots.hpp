#pragma once

#include "compare/comparison.hpp"
#include "compare/measured_responses.hpp"
#include "report/figures/figure.hpp"

#include <vector>

namespace flexarm::report {

/// The pictures of a comparison: error against degrees of freedom for each family, the same for the
/// bases of assumed_modes, a pole-zero map and a Bode diagram a sensor, and the mode shapes. What
/// was measured is in the maps; each measured response is a Bode diagram with all models, its
/// coherence where there is one, and each table of measured shapes a MAC matrix.
std::vector<NamedFigure> comparison_plots(const compare::Comparison& comparison,
                                          const compare::MeasuredComparison& measured = {});

}  // namespace flexarm::report
