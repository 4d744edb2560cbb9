#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::measured {

/// A unit that a JSON or MATLAB file tells beside its signals.
struct KeyedUnit {
  std::string path;  ///< of the structure that it stands in
  std::string key;   ///< of the signal that it belongs to; empty: the one in the same structure
  std::string text;
  bool is_listed = false;  ///< in a structure or a list of units alone
  std::string place = {};  ///< where it stands: "units.hub_angle"
};

/// Whether a key tells that units are behind it: "unit", "Units".
bool is_unit_key(std::string_view key);

/// The key of the list that "hub_angle_unit" or "hubAngleUnit" tells the unit of; empty for "unit";
/// nothing for any other key.
std::optional<std::string> list_of_unit_key(std::string_view key);

/// The unit that a text at `path` is by its name, "s.tau_unit" or "units.s.tau"; without a key for
/// any other.
KeyedUnit keyed_unit(std::string_view path, const std::string& text);

/// Units of signals, told by the name of the signal: `tau_unit` beside `tau`, `units.tau` beside it
/// or around the structure that has it, or, of a signal that is not there, elsewhere. Names are
/// paths; "s.tau(2)" and "s.tau.value" are "s.tau", too.
class KeyedUnits {
 public:
  /// Takes a unit, but none without a key or a text. Throws InputError for a second one of a signal
  /// in one structure.
  void add(KeyedUnit unit);

  /// Gives the units to `signals`, the paths of all signals and single numbers, which are called
  /// `kind` in an error. Throws InputError for two units of one, and for a known unit in a
  /// structure of units that is of none.
  void place(std::span<const std::string> signals, std::string_view kind);

  /// The unit of a signal, its text canonical; null: not told.
  const KeyedUnit* find(std::string_view path) const;

  /// Whether the text at `place` is the unit of a signal or a number.
  bool is_placed(std::string_view place) const { return placed_.contains(place); }

 private:
  const KeyedUnit* nearest(std::string_view path) const;

  std::map<std::pair<std::string, std::string>, KeyedUnit> told_;  ///< by structure and name within
  std::map<std::string, KeyedUnit, std::less<>> given_;            ///< by the path of the signal
  std::set<std::string, std::less<>> placed_;
};

}  // namespace flexarm::measured
