#pragma once

#include <string>
#include <string_view>

namespace flexarm::measured {

/// A unit in the spelling of docs/formats.md: "Nm" and "N*m" are "N m", "sec" is "s", "m/s2" is
/// "m/s^2" (`find_unit`); one that is not known is returned as it stands. Also strips one pair of
/// brackets.
std::string canonical_unit(std::string_view unit);

/// A column's header taken apart.
struct ColumnName {
  std::string base;  ///< "Time"
  std::string unit;  ///< canonical; empty where none is told
};

/// "Time (ms)", "torque [N m]", "t_s", "hub1_deg", "angle / rad": the unit in brackets, after a
/// slash between blanks, or, when it is a known one, after the last underscores or blanks. In
/// brackets it may follow a word and "in", as in "angle (Theta in rad)"; "data(:,1)" has none.
ColumnName split_column_name(std::string_view header);

}  // namespace flexarm::measured
