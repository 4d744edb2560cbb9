#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::measured {

/// Units of signals, told by the name of the signal: `tau_unit` beside `tau`, `units.tau` beside it
/// or around the structure that has it. Names are paths, as "s.tau" and "tau.value".
class KeyedUnits {
 public:
  /// Takes a text, if it is such a unit. Throws InputError for a second unit of one signal.
  void take(std::string_view path, const std::string& text);

  /// Marks the texts that are units of `numbers`, the paths of all signals and single numbers.
  /// Throws InputError for a known unit in a structure `units` that is of none.
  void place(std::span<const std::string> numbers);

  /// The unit of a signal, canonical; empty: not told.
  std::string of(std::string_view path) const;

  /// Whether the text at `path` is the unit of a signal or a number.
  bool is_placed(std::string_view path) const { return placed_.contains(path); }

 private:
  struct Told {
    std::string unit;
    std::string path;
    bool is_listed = false;  ///< in a structure of units
  };

  const Told* find(std::string_view path) const;
  const Told* find_around(std::string_view path) const;

  std::map<std::pair<std::string, std::string>, Told> told_;  ///< by structure and name within
  std::set<std::string, std::less<>> placed_;
};

}  // namespace flexarm::measured
