#pragma once

#include "report/figure.hpp"
#include "report/figure_layout.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// "0.1", "10", "1000" for 10^exponent near 1, "10⁻⁸" elsewhere.
std::string decade_label(int exponent);

/// Ticks of a logarithmic axis: labelled decades, as many of them as `most_labels` allows, and
/// unlabelled ones between (the digits 2 to 9, or the decades left out); where a range holds fewer
/// than two decades, 2 and 5 are labelled too.
std::vector<Tick> logarithmic_ticks(const Range& range, int most_labels);

}  // namespace flexarm::report
