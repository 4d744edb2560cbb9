#pragma once

#include "compare/mac.hpp"
#include "report/figures/figure.hpp"

namespace flexarm::report {

/// The MAC matrix of the first model: a square for each pair of a measured mode (rows) and a
/// computed one (columns), its side by the value, with the value beside it.
Figure mac_figure(const compare::ShapeCorrelation& shapes);

}  // namespace flexarm::report
