#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/figure_layout.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// What the panels of a stack show.
struct StackRanges {
  std::vector<Range> x;            ///< [panel]; the stack's where a panel has no axis of its own
  std::vector<Range> y;            ///< [panel]
  std::vector<std::string> notes;  ///< [panel]: points outside a robust range; empty: none
};

/// Limits that are given, or from the data with a margin. Throws as `lay_out` does.
StackRanges ranges_of(const PanelStack& stack);

/// Whether any of a series shows in its panel.
bool is_shown(const Series& series, const Axis& x_axis, const Axis& y_axis, const Range& x,
              const Range& y);

}  // namespace flexarm::report
