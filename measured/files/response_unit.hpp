#pragma once

#include "arm/input_error.hpp"

#include <string>
#include <string_view>

namespace flexarm::measured {

/// The unit of a frequency response: of what was measured, and of what it is a response to.
struct ResponseUnit {
  std::string unit;  ///< canonical; empty: not told
  std::string per;   ///< canonical: a torque, a force, a voltage or a current; empty: not told
};

/// "rad/N m", "deg/(N m)", "(m/s^2)/N", "ustrain per Nm" taken apart; any other unit, "rad/s", is
/// of what was measured.
ResponseUnit split_response_unit(std::string_view text);

/// Whether it is a response's unit upside down: "N m/rad", "N/m".
bool is_stiffness_unit(std::string_view text);

/// Hz in one of a canonical unit of frequencies, Hz, kHz, rad/s or rpm; 0 for any other.
double hertz_in_one(std::string_view unit);

/// The error for frequencies in another unit; `what` are the frequencies, as they may stand in a
/// line.
arm::InputError no_unit_of_frequencies(const std::string& what, const std::string& unit);

}  // namespace flexarm::measured
