#pragma once

#include "compare/sweep_result.hpp"
#include "report/comparison_plots.hpp"
#include "report/figure.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// Over one parameter: poles, the zeros of each sensor (on the imaginary axis and off it apart),
/// and what belongs to the modes, every model laid over the others. Over two: the same as families
/// of curves over the last parameter, a colour for each of some values of the first, a panel for
/// each of the first few poles or zeros.
std::vector<NamedPlot> sweep_plots(const compare::SweepResult& result);

/// A level that a curve goes to, drawn across the picture, and a measured value, drawn as a marker.
struct SweepMark {
  std::string name;
  double x = 0.0;  ///< of a marker
  double y = 0.0;
};

/// One panel: the poles, or the zeros of the first sensor, of a sweep over one parameter [Hz], with
/// limits and measured values beside them. Figures 18 and 19 of the paper.
Figure frequencies_figure(const compare::SweepResult& result, bool zeros, const std::string& title,
                          const std::vector<SweepMark>& limits,
                          const std::vector<SweepMark>& measured);

}  // namespace flexarm::report
