#pragma once

#include "report/figures/figure.hpp"

#include <vector>

namespace flexarm::report {

/// A figure of each kind that the program draws, of models and data that are known.
std::vector<NamedFigure> reference_figures();

}  // namespace flexarm::report
