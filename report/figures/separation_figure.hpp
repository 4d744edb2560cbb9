#pragma once

#include "diagnose/planning/plan.hpp"
#include "report/figures/figure.hpp"

namespace flexarm::report {

/// The matrix of separations: an effect a row, a rival a column, the letters of
/// `separation_matrix`; a colour each for tied, told by little, told.
Figure separation_figure(const diagnose::Plan& plan);

}  // namespace flexarm::report
