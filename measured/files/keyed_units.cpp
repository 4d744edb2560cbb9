#include "measured/files/keyed_units.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

/// Where the fields of a path begin.
std::vector<std::size_t> field_begins(string_view path) {
  std::vector<std::size_t> begins = {0};
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '.') begins.push_back(i + 1);
  }
  return begins;
}

/// The paths that a signal goes by: "s.tau(2)" and "s.tau", "s.tau.value" and "s.tau".
std::vector<string_view> signal_names(string_view path) {
  std::vector<string_view> names = {path};
  while (true) {
    const std::size_t field = path.rfind('.') + 1;  // 0 without a point
    const auto index = path.rfind('(');
    if (path.ends_with(')') && index != string_view::npos && index > field) {
      path = path.substr(0, index);
    } else if (field > 0 && is_holder(path.substr(field))) {
      path = path.substr(0, field - 1);
    } else {
      return names;
    }
    names.push_back(path);
  }
}

/// Whether the path, or what is behind one of its points, is called `key`.
bool is_called(string_view path, string_view key) {
  return std::ranges::any_of(signal_names(path), [&](string_view name) {
    return name.ends_with(key) &&
           (name.size() == key.size() || name[name.size() - key.size() - 1] == '.');
  });
}

void require_same(const KeyedUnit& unit, const KeyedUnit& other) {
  if (unit.text == other.text) return;
  throw InputError(fmt::format("{} = {}: {} has another unit; must be the same",
                               arm::shown(unit.place), arm::shown(unit.text),
                               arm::shown(other.place)));
}

}  // namespace

bool is_unit_key(string_view key) {
  const std::string letters = plain_letters(key);
  return letters == "unit" || letters == "units";
}

std::optional<std::string> list_of_unit_key(string_view key) {
  if (is_unit_key(key)) return "";
  for (const string_view end :
       {"_unit", "_units", "_Unit", "_Units", "Unit", "Units", " unit", " units"}) {
    if (key.size() > end.size() && key.ends_with(end)) {
      return std::string(key.substr(0, key.size() - end.size()));
    }
  }
  return std::nullopt;
}

KeyedUnit keyed_unit(string_view path, const std::string& text) {
  std::size_t from = 0;
  while (true) {
    const auto point = path.find('.', from);
    const string_view field = path.substr(from, point - from);
    const std::string around(path.substr(0, from == 0 ? 0 : from - 1));
    if (point == string_view::npos) {
      return {around, list_of_unit_key(field).value_or(""), text, false, std::string(path)};
    }
    if (is_unit_key(field)) {
      return {around, std::string(path.substr(point + 1)), text, true, std::string(path)};
    }
    from = point + 1;
  }
}

void KeyedUnits::add(KeyedUnit unit) {
  unit.text = canonical_unit(unit.text);
  if (unit.key.empty() || unit.text.empty()) return;
  const auto [first, is_new] = told_.try_emplace({unit.path, unit.key}, unit);
  require_same(unit, first->second);
}

const KeyedUnit* KeyedUnits::nearest(string_view path) const {
  for (const string_view name : signal_names(path)) {
    const auto begins = field_begins(name);
    const auto told_in = [&](string_view structure, std::size_t begin) {
      const auto told = told_.find({std::string(structure), std::string(name.substr(begin))});
      return told == told_.end() ? nullptr : &told->second;
    };
    for (const std::size_t begin : begins | std::views::reverse) {
      const auto* unit = told_in(name.substr(0, begin == 0 ? 0 : begin - 1), begin);
      if (unit != nullptr) return unit;
    }
    for (const std::size_t begin : begins) {
      if (const auto* unit = told_in("", begin)) return unit;
    }
  }
  return nullptr;
}

void KeyedUnits::place(std::span<const std::string> signals, string_view kind) {
  const auto give = [&](const std::string& path, const KeyedUnit& unit) {
    require_same(unit, given_.emplace(path, unit).first->second);
    placed_.insert(unit.place);
  };
  for (const auto& path : signals) {
    if (const auto* unit = nearest(path)) give(path, *unit);
  }
  for (const auto& [key, unit] : told_) {
    if (is_placed(unit.place)) continue;
    for (const auto& path : signals) {
      const bool is_open = unit.is_listed || !given_.contains(path);
      if (is_open && is_called(path, unit.key)) give(path, unit);
    }
    if (is_placed(unit.place) || !unit.is_listed || !is_canonical_unit(unit.text)) continue;
    throw InputError(fmt::format("{} = {}: no {} has this name; must be one of {}",
                                 arm::shown(unit.place), unit.text, kind, shown_names(signals)));
  }
}

const KeyedUnit* KeyedUnits::find(string_view path) const {
  const auto given = given_.find(path);
  return given == given_.end() ? nullptr : &given->second;
}

}  // namespace flexarm::measured
