#pragma once

#include <string>

namespace flexarm::arm {

/// Returns a unit as it stands behind a number: " N m"; empty for "1".
inline std::string unit_suffix(const std::string& unit) {
  return unit == "1" ? "" : " " + unit;
}

}  // namespace flexarm::arm
