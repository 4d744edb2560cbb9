#include "app/column_choice.hpp"

#include "app/command.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"
#include "measured/files/column_name.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace flexarm::app {

namespace {

using arm::InputError;
using measured::ColumnLabel;
using measured::ColumnMapping;

const ColumnLabel* find(std::span<const ColumnLabel> columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &ColumnLabel::name);
  return found == columns.end() ? nullptr : &*found;
}

/// What stands in front of the `count`-th colon from the right, and what is behind it.
std::optional<std::pair<std::string_view, std::string_view>> split_at_colon(std::string_view text,
                                                                            int count) {
  std::size_t at = text.size();
  for (int i = 0; i < count; ++i) {
    if (at == 0) return std::nullopt;
    at = text.rfind(':', at - 1);
    if (at == std::string_view::npos) return std::nullopt;
  }
  return std::pair{text.substr(0, at), text.substr(at + 1)};
}

/// Throws for a column that is not there; "Moment" may be meant as "Moment (N m)".
[[noreturn]] void refuse(std::string_view name, std::span<const ColumnLabel> columns) {
  std::vector<std::string> names;
  std::vector<std::string> bases;
  for (const auto& column : columns) {
    names.push_back(column.name);
    bases.push_back(measured::split_column_name(column.name).base);
  }
  std::string meant = arm::did_you_mean(name, names);
  if (const auto base = arm::nearest_name(name, bases); meant.empty() && base) {
    const auto place = std::ranges::find(bases, *base) - bases.begin();
    meant = fmt::format(" (did you mean {}?)", names[static_cast<std::size_t>(place)]);
  }
  throw InputError(fmt::format("column {}: not in the file{}; it has {}", arm::shown(name), meant,
                               arm::shown(fmt::format("{}", fmt::join(names, ", ")), 400)));
}

/// NAME, NAME:UNIT or NAME:UNIT:SCALE; a name may hold colons, so that the file tells which it is.
ColumnMapping read_mapping(const std::string& quantity, std::string_view text,
                           std::span<const ColumnLabel> columns) {
  ColumnMapping mapping;
  const ColumnLabel* label = find(columns, text);
  std::string_view unit;
  std::string_view scale;
  for (int colons = 1; label == nullptr && colons <= 2; ++colons) {
    const auto parts = split_at_colon(text, colons);
    if (!parts) break;
    label = find(columns, parts->first);
    unit = parts->second.substr(0, parts->second.find(':'));
    scale = colons == 1 ? std::string_view() : parts->second.substr(unit.size() + 1);
  }
  if (label == nullptr) {
    refuse(text.substr(0, text.find(':')), columns);
  }
  mapping.name = label->name;
  mapping.unit = unit.empty() ? label->unit : measured::canonical_unit(unit);
  if (mapping.unit.empty()) mapping.unit = std::string(measured::si_unit_of(quantity));
  if (!scale.empty()) mapping.scale = read_scale(scale);
  measured::require_valid(quantity, mapping, !scale.empty());
  return mapping;
}

}  // namespace

double read_scale(std::string_view text) {
  double scale = 1.0;
  bool divides = false;
  for (std::string_view rest = text;;) {
    const auto end = std::min(rest.find_first_of("*/"), rest.size());
    const std::string_view factor = rest.substr(0, end);
    const auto number =
        factor == "pi" ? std::optional(std::numbers::pi) : arm::parse_number<double>(factor);
    if (!number) {
      throw InputError(
          fmt::format("scale = {}: must be a product of numbers and pi, as in "
                      "0.202*pi/180",
                      arm::shown(text)));
    }
    scale = divides ? scale / *number : scale * *number;
    if (end == rest.size()) return scale;
    divides = rest[end] == '/';
    rest.remove_prefix(end + 1);
  }
}

measured::ColumnMappings ColumnChoice::mappings(std::span<const ColumnLabel> columns) const {
  measured::ColumnMappings mappings;
  for (const auto& text : typed) {
    try {
      const auto equals = text.find('=');
      if (equals == std::string::npos) {
        throw InputError("must be QUANTITY=NAME, QUANTITY=NAME:UNIT or QUANTITY=NAME:UNIT:SCALE");
      }
      const std::string quantity =
          measured::standard_name(std::string_view(text).substr(0, equals));
      const auto mapping =
          read_mapping(quantity, std::string_view(text).substr(equals + 1), columns);
      if (!mappings.emplace(quantity, mapping).second) {
        throw InputError(fmt::format("{} given twice", quantity));
      }
    } catch (const InputError& error) {
      throw InputError(fmt::format("--column {}: {}", arm::shown(text), error.what()));
    }
  }
  return mappings;
}

void add_column_choice(CLI::App& parser, ColumnChoice& choice) {
  parser
      .add_option("--column", choice.typed,
                  "QUANTITY=NAME:UNIT:SCALE: column NAME is time, torque or a sensor, in UNIT "
                  "(default: that of the file) times SCALE, e.g. 8.925 or 0.202*pi/180, a "
                  "conversion factor to SI. Repeat for more columns")
      ->check(not_empty())
      ->allow_extra_args(false);
}

}  // namespace flexarm::app
