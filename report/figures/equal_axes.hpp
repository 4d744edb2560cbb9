#pragma once

#include "report/figures/figure.hpp"

#include <complex>
#include <span>
#include <string>

namespace flexarm::report {

/// A square piece of a complex plane to scale.
struct EqualAxes {
  std::string quantity;  ///< "G": the axes are Re G and Im G
  std::string unit;
  std::complex<double> centre;
  double half_side = 1.0;  ///< above 0

  /// Both axes, and the lines Re = 0 and Im = 0 where they cross the piece.
  Panel panel(std::string title) const;
};

/// Imaginary over real parts. Values that are not finite are gaps.
Series complex_series(std::string name, std::span<const std::complex<double>> values,
                      const Style& style);

/// Lines along both coordinate axes across a panel.
void add_coordinate_axes(Panel& panel, double left, double right, double bottom, double top);

Style thin_line(int colour, Line line = Line::solid);

/// A marker without a line.
Style marker_style(int colour, Marker marker, double size);

}  // namespace flexarm::report
