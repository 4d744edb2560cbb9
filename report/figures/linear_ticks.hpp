#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/figure_layout.hpp"

#include <functional>
#include <string>
#include <vector>

namespace flexarm::report {

/// Ticks whose labels are the value over 10^exponent.
struct LinearTicks {
  std::vector<Tick> ticks = {};
  int exponent = 0;
};

/// Round numbers across a linear axis, 1, 2 or 5 times a power of ten apart, as many as have room:
/// `room_px` of a label is the length that it needs along the axis. Numbers with many zeros have
/// their power of ten, a multiple of three, in the exponent instead.
LinearTicks linear_ticks(const Range& range, double length_px,
                         const std::function<double(const std::string&)>& room_px);

/// "10⁻³ rad", "10⁻³" and "rad".
std::string scaled_unit(int exponent, const std::string& unit);

}  // namespace flexarm::report
