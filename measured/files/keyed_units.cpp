#include "measured/files/keyed_units.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/json_units.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace flexarm::measured {

using std::string_view;

void KeyedUnits::take(string_view path, const std::string& text) {
  std::string around;
  std::string name;
  bool is_listed = false;
  std::size_t from = 0;
  for (auto point = path.find('.'); point != string_view::npos; point = path.find('.', from)) {
    if (is_unit_key(path.substr(from, point - from))) {
      around = path.substr(0, from == 0 ? 0 : from - 1);
      name = path.substr(point + 1);
      is_listed = true;
      break;
    }
    from = point + 1;
  }
  if (!is_listed) {
    around = path.substr(0, from == 0 ? 0 : from - 1);
    name = list_of_unit_key(path.substr(from)).value_or("");
  }
  if (name.empty() || text.empty()) return;
  const auto [place, is_new] =
      told_.try_emplace({around, name}, Told{canonical_unit(text), std::string(path), is_listed});
  if (is_new || place->second.unit == canonical_unit(text)) return;
  throw arm::InputError(fmt::format("{} = {}: {} has another unit; must be the same",
                                    arm::shown(std::string(path)), arm::shown(text),
                                    arm::shown(place->second.path)));
}

const KeyedUnits::Told* KeyedUnits::find(string_view path) const {
  for (auto point = path.rfind('.');; point = path.rfind('.', point - 1)) {
    const bool is_whole = point == string_view::npos;
    const auto found = told_.find({std::string(is_whole ? string_view() : path.substr(0, point)),
                                   std::string(is_whole ? path : path.substr(point + 1))});
    if (found != told_.end()) return &found->second;
    if (is_whole || point == 0) break;
  }
  for (auto point = path.find('.'); point != string_view::npos; point = path.find('.', point + 1)) {
    const auto found = told_.find({std::string(), std::string(path.substr(point + 1))});
    if (found != told_.end()) return &found->second;
  }
  return nullptr;
}

/// "tau.value" is a signal tau.
const KeyedUnits::Told* KeyedUnits::find_around(string_view path) const {
  while (true) {
    if (const auto* found = find(path)) return found;
    const auto point = path.rfind('.');
    if (point == string_view::npos || !is_holder(path.substr(point + 1))) return nullptr;
    path = path.substr(0, point);
  }
}

void KeyedUnits::place(std::span<const std::string> numbers) {
  for (const auto& path : numbers) {
    if (const auto* found = find_around(path)) placed_.insert(found->path);
  }
  for (const auto& [key, told] : told_) {
    if (!told.is_listed || is_placed(told.path) || !is_canonical_unit(told.unit)) continue;
    throw arm::InputError(
        fmt::format("{} = {}: no signal has this name; must be one of {}", arm::shown(told.path),
                    told.unit, arm::shown(fmt::format("{}", fmt::join(numbers, ", ")), 400)));
  }
}

std::string KeyedUnits::of(string_view path) const {
  const auto* found = find_around(path);
  return found == nullptr ? "" : found->unit;
}

}  // namespace flexarm::measured
