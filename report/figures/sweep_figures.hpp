#pragma once

#include "compare/paper/paper_sweeps.hpp"
#include "compare/sweeps/sweep_result.hpp"
#include "report/figures/figure.hpp"

#include <vector>

namespace flexarm::report {

/// Over one parameter: poles, the zeros of each sensor (on the imaginary axis and off it apart),
/// and what belongs to the modes, every model laid over the others. Over two: the same as families
/// of curves over the last parameter, a colour for each of some values of the first, a panel for
/// each of the first few poles or zeros.
std::vector<NamedFigure> sweep_plots(const compare::SweepResult& result);

/// The figure of the paper that `result` was computed for: `sweep.task` with any models. One panel,
/// frequencies with their limits and what was measured.
Figure paper_sweep_figure(const compare::PaperSweep& sweep, const compare::SweepResult& result);

}  // namespace flexarm::report
