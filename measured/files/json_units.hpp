#pragma once

#include "measured/files/foreign_table.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// A unit that a JSON file tells beside its lists.
struct JsonUnit {
  std::string path;  ///< of the object that it stands in
  std::string key;   ///< of the list that it belongs to; empty: the list in the same object
  std::string text;
  bool is_listed = false;  ///< in an object or a list of units alone
  std::string place = {};  ///< where it stands: "units.hub_angle"
};

/// Whether a key tells that units are behind it: "unit", "Units".
bool is_unit_key(std::string_view key);

/// The key of the list that "hub_angle_unit" or "hubAngleUnit" tells the unit of; empty for "unit";
/// nothing for any other key.
std::optional<std::string> list_of_unit_key(std::string_view key);

/// Gives columns the units that the file tells beside them. `singles` are the names of its single
/// values, which have units too. Throws InputError for a unit that differs from the one in the name
/// of its column, for one that stands beside several lists, and for a known one in an object of
/// units that no list or single value has the name of.
void set_units(std::vector<ForeignColumn>& columns, std::span<const JsonUnit> units,
               std::span<const std::string> singles);

}  // namespace flexarm::measured
