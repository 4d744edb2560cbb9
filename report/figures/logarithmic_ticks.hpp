#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/figure_layout.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// 10^exponent as "0.01" or "1000" when `plain`, else as "10⁻²" or "10³".
std::string decade_label(int exponent, bool plain);

/// Ticks of a logarithmic axis: labelled decades, as many of them as `most_labels` allows, and
/// unlabelled ones between (the digits 2 to 9, or the decades left out); where a range holds fewer
/// than two decades, 2 and 5 are labelled too, within one decade every digit that has room.
/// One axis writes its numbers in one way: plainly where its decades lie from 0.001 to 10000, else
/// as "5·10⁻⁴".
std::vector<Tick> logarithmic_ticks(const Range& range, int most_labels);

}  // namespace flexarm::report
