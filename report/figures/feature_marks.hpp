#pragma once

#include "measured/modal/peaks.hpp"
#include "report/figures/figure.hpp"

#include <span>
#include <string>

namespace flexarm::report {

/// What a panel shows of the power that features are levels of.
enum class FeatureLevel { power, amplitude };

/// Crosses for peaks, circles for valleys, on the line where each was found; the frequency is
/// written above or below, in the unit of the axis, of the most prominent ones first
/// (`place_labels`).
void add_feature_marks(Panel& panel, std::span<const measured::SpectralFeature> features,
                       FeatureLevel level);

/// Sets the limits of a logarithmic y axis: the decades that the lines hold, and `room` of them
/// above and below. Values more than three decades below the lowest fiftieth set none, as one at an
/// exact zero.
void fix_limits(Panel& panel, double room);

/// Faint lines from the bottom of a panel with limits to its top.
void add_frequency_lines(Panel& panel, std::span<const double> frequency_Hz,
                         const std::string& name, const Style& style);

/// Of analytical poles: faint, dashed.
Style analytical_pole_style();

}  // namespace flexarm::report
