#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace flexarm::fmu {

/// A unit in terms of the base units of the SI, and rad.
struct SiUnit {
  std::map<std::string, int> exponents = {};  ///< of "kg", "m", "s", "A", "K", "rad"; none is 0
  double factor = 1.0;                        ///< base units in one unit

  bool operator==(const SiUnit&) const = default;
};

/// "N m s/rad": symbols with a whole exponent, blanks between factors; those behind the stroke
/// divide. Empty for a text that is none, or has a symbol that is not known here.
std::optional<SiUnit> parse_si_unit(std::string_view unit);

}  // namespace flexarm::fmu
