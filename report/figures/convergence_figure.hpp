#pragma once

#include "report/figures/figure.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

/// The error of one pole or zero of one formulation over its refinement.
struct ConvergenceCurve {
  std::string formulation;  ///< one colour each, in the order of first appearance
  std::string feature;      ///< "pole 1"; one marker and shade each
  std::vector<double> degrees_of_freedom;
  std::vector<double> relative_error;
};

/// A broken line error ~ degrees_of_freedom^-order above the curves of one formulation; left out
/// where these never fall at half that order below an error of 1e-2.
struct ReferenceSlope {
  std::string formulation;
  double order = 0.0;
};

struct ConvergencePlot {
  std::string title;
  std::vector<ConvergenceCurve> curves;
  std::vector<ReferenceSlope> slopes = {};
  std::optional<double> rounding_level = {};  ///< a dotted line, named in the legend
};

/// Half an epsilon: an error below it, zero included, is drawn at it, for no double is nearer.
inline constexpr double kSmallestDrawnError = 0x1p-53;

/// Relative error over degrees of freedom, both logarithmic, with the legend beside the plot.
/// Throws std::invalid_argument for a curve whose two vectors differ in length.
Figure convergence_figure(const ConvergencePlot& plot);

}  // namespace flexarm::report
