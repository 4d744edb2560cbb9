#pragma once

#include <span>
#include <string_view>

namespace flexarm::measured {

/// A unit in which a column of a measurement may be written: value [SI] = value [unit] times
/// `factor` over `divisor`. Two numbers, so that 7 ms is the double nearest to 0.007.
struct Unit {
  std::string_view name;
  double factor = 1.0;
  double divisor = 1.0;

  double to_si(double value) const { return value * factor / divisor; }
};

/// The units that may stand for `si_unit`, itself first: "s", "N m", "rad", "rad/s", "m/s^2", "m",
/// "1". Throws std::invalid_argument for any other.
std::span<const Unit> units_for(std::string_view si_unit);

}  // namespace flexarm::measured
