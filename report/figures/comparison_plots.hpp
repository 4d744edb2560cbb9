#pragma once

#include "compare/comparison.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

struct NamedPlot {
  std::string file_name;  ///< "convergence-poles.svg"
  std::string svg;
};

/// The pictures of a comparison: error against degrees of freedom for each family, the same for the
/// bases of assumed_modes, a pole-zero map and a Bode diagram a sensor, and the mode shapes.
std::vector<NamedPlot> comparison_plots(const compare::Comparison& comparison);

}  // namespace flexarm::report
