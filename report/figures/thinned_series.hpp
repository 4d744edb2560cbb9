#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/figure_layout.hpp"

namespace flexarm::report {

/// What shows of a series in a panel that is `width_px` wide and shows `range` of x: of each column
/// of pixels (of markers without a line, of three) the first, least, largest and last point, of an
/// area those of both its sides. So a line covers the pixels that all of its points would cover
/// but for what happens within one column, and every extreme remains.
///
/// Gaps remain where they lie between points that do. A column of up to four points is left as it
/// is. So is the whole series where it has no more than four points a column on average, and where
/// x descends anywhere, as around a locus.
Series thinned(const Series& series, const Axis& x, const Axis& y, const Range& range,
               double width_px);

}  // namespace flexarm::report
