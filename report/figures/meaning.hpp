#pragma once

#include "report/figures/figure.hpp"

namespace flexarm::report {

/// One colour for each meaning, in all figures: black, blue and vermillion have no other.
/// Formulations have others (overlay_style.hpp).
inline constexpr int kMeasuredColour = black;
inline constexpr int kBaselineColour = blue;          ///< the arm file, before a diagnosis
inline constexpr int kIdentifiedColour = vermillion;  ///< the extended arm, a fit
inline constexpr int kPoleColour = purple;            ///< and peaks
inline constexpr int kZeroColour = green;             ///< and minima

inline constexpr const char* kBaselineName = "arm file";
inline constexpr const char* kExtendedName = "extended arm";

}  // namespace flexarm::report
