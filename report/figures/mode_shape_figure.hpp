#pragma once

#include "report/figures/figure.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

struct ModeShapeCurve {
  std::string formulation;
  std::vector<double> displacement;  ///< one a station, in the scaling that the caller chose
};

struct ModeShape {
  std::string label;  ///< "mode 1, 11.862 Hz"
  std::vector<ModeShapeCurve> curves;
};

struct ModeShapePlot {
  std::string title;
  std::vector<double> station_m;  ///< distance from the motor axis
  std::vector<ModeShape> modes;
  std::string displacement_unit = "m";
};

/// One small panel a mode, in one column for up to three modes and in two for more; curves of the
/// formulations lie on one another. Throws std::invalid_argument when a shape has not one value a
/// station.
Figure mode_shape_figure(const ModeShapePlot& plot);

}  // namespace flexarm::report
