#pragma once

#include "report/figures/figure.hpp"

#include <cstddef>

namespace flexarm::report {

/// The colour of the i-th of several formulations, or of other curves without a meaning of their
/// own (meaning.hpp), in every figure.
int formulation_colour(std::size_t i);

/// The line of the i-th of several curves that may coincide: a broad pale band below, a full line
/// on it, broken lines on top, so that each shows where they agree.
Style overlay_style(std::size_t i);

}  // namespace flexarm::report
