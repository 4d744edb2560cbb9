#pragma once

#include "report/figures/figure.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::report {

/// Whether a gap lies before the i-th frequency: ten times as wide as the steps to both sides of
/// it, of those there are.
bool begins_band(const std::vector<double>& frequency_Hz, std::size_t i);

/// Values at the lines of a spectrum or at the frequencies of a stepped sine, with a gap
/// wherever a band begins: no line joins one resonance that was measured to the next. Fewer than
/// two hundred points are marked, each on its own.
Series measured_curve(std::string name, const std::vector<double>& frequency_Hz,
                      const std::vector<double>& values);

/// What lies between `low` and `high`, with the same gaps: an area, or a bar at each of fewer than
/// two hundred points.
Series measured_interval(std::string name, const std::vector<double>& frequency_Hz,
                         const std::vector<double>& low, const std::vector<double>& high);

}  // namespace flexarm::report
