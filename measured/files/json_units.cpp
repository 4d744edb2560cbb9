#include "measured/files/json_units.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;
using Columns = std::vector<ForeignColumn*>;

/// The part of a name behind "path."; nothing where it stands elsewhere.
std::optional<string_view> within(string_view name, string_view path) {
  if (path.empty()) return name;
  if (name.size() <= path.size() + 1 || !name.starts_with(path) || name[path.size()] != '.') {
    return std::nullopt;
  }
  return name.substr(path.size() + 1);
}

/// Whether `name` is `key`, a row of lists in it, key(2), or a field that holds it, key.values.
bool is_of_key(string_view name, string_view key) {
  if (!name.starts_with(key)) return false;
  const string_view rest = name.substr(key.size());
  return rest.empty() || rest.front() == '(' || (rest.front() == '.' && is_holder(rest.substr(1)));
}

/// The columns of a key: in the object of the unit, or else at any depth elsewhere.
Columns columns_of_key(std::vector<ForeignColumn>& columns, const JsonUnit& unit) {
  Columns own;
  Columns elsewhere;
  for (auto& column : columns) {
    const auto rest = within(column.name, unit.path);
    if (rest && is_of_key(*rest, unit.key)) own.push_back(&column);
    for (string_view name = column.name; !name.empty();) {
      if (is_of_key(name, unit.key)) {
        elsewhere.push_back(&column);
        break;
      }
      const auto point = name.find('.');
      name.remove_prefix(point == string_view::npos ? name.size() : point + 1);
    }
  }
  return own.empty() ? elsewhere : own;
}

/// The column in the object of a unit without a key, the one that holds values where there are
/// several.
Columns columns_beside(std::vector<ForeignColumn>& columns, const JsonUnit& unit) {
  Columns beside;
  Columns holders;
  for (auto& column : columns) {
    const auto rest = within(column.name, unit.path);
    if (!rest || column.is_text()) continue;
    beside.push_back(&column);
    if (is_holder(*rest)) holders.push_back(&column);
  }
  if (beside.size() < 2) return beside;
  if (!holders.empty()) return holders;
  if (!is_canonical_unit(canonical_unit(unit.text))) return {};
  throw InputError(
      fmt::format("{} = {}: stands beside several lists, {} and {}; write the unit of a list in "
                  "its name, \"hub_angle [deg]\", or as \"hub_angle_unit\"",
                  arm::shown(unit.place), arm::shown(unit.text), arm::shown(beside[0]->name),
                  arm::shown(beside[1]->name)));
}

void require_known_key(const JsonUnit& unit, const std::vector<ForeignColumn>& columns,
                       std::span<const std::string> singles) {
  const bool is_of_single = std::ranges::any_of(singles, [&](const std::string& name) {
    return name == unit.key || name.ends_with("." + unit.key);
  });
  if (!unit.is_listed || is_of_single || !is_canonical_unit(canonical_unit(unit.text))) return;
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.name);
  throw InputError(fmt::format("{} = {}: no list has this name; must be one of {}",
                               arm::shown(unit.place), arm::shown(unit.text),
                               arm::shown(fmt::format("{}", fmt::join(names, ", ")), 400)));
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

void set_units(std::vector<ForeignColumn>& columns, std::span<const JsonUnit> units,
               std::span<const std::string> singles) {
  for (const auto& unit : units) {
    const std::string text = canonical_unit(unit.text);
    if (text.empty()) continue;
    const Columns found =
        unit.key.empty() ? columns_beside(columns, unit) : columns_of_key(columns, unit);
    if (found.empty() && !unit.key.empty()) require_known_key(unit, columns, singles);
    for (ForeignColumn* column : found) {
      if (!column->unit.empty() && column->unit != text) {
        throw InputError(fmt::format("{} = {}: the unit of {} is {} already; must be the same",
                                     arm::shown(unit.place), arm::shown(unit.text),
                                     arm::shown(column->name), arm::shown(column->unit)));
      }
      column->unit = text;
    }
  }
}

}  // namespace flexarm::measured
