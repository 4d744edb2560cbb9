#pragma once

#include "report/figures/figure.hpp"

#include <string>

namespace flexarm::report {

/// The label of the axis of magnitudes of frequency responses, which is logarithmic as it is made.
inline constexpr const char* kMagnitude = "magnitude";

enum class MagnitudeScale { absolute, decibel };
enum class FrequencyUnit { hertz, radians_per_second };

/// A frequency as it is written beside its point, in the unit of the axis.
std::string frequency_text(double frequency);

/// The quantities of a figure's axes in the units that are asked for: axes of magnitudes absolute
/// or in dB, axes in Hz in Hz or rad/s, with everything on them.
Figure in_units(Figure figure, MagnitudeScale magnitude, FrequencyUnit frequency);

}  // namespace flexarm::report
