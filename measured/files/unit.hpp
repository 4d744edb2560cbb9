#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

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

/// SI units in one `unit`, a canonical one beyond those of `units_for`: "ns", "kgf cm", "rpm", "cm".
/// Empty for any other. Records are not written in these; of a foreign log they stand for a scale
/// that is not given.
std::optional<double> other_unit_scale(std::string_view si_unit, std::string_view unit);

/// The names of those units.
std::vector<std::string_view> other_units(std::string_view si_unit);

}  // namespace flexarm::measured
