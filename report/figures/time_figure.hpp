#pragma once

#include "report/figures/figure.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// A signal at the plot's times.
struct TimeCurve {
  std::string name;  ///< for the legend; may be empty
  std::vector<double> values;
};

/// Signals of one quantity, the first below the others.
struct TimePanel {
  std::string label;
  std::string unit;
  std::vector<TimeCurve> curves;
  bool robust = false;  ///< outliers do not set the limits
};

/// Signals over time, as in the paper's Figures 20 to 23.
struct TimePlot {
  std::string title;
  std::vector<double> time_s;
  std::vector<TimePanel> panels;
};

/// The panels one above the other on one time axis. Throws std::invalid_argument when a curve has
/// not one value a time, or there is no panel.
Figure time_figure(const TimePlot& plot);

}  // namespace flexarm::report
