#include "measured/files/column_guess.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

/// Names in use for a quantity, in lower case and without what is no letter.
struct Aliases {
  const char* quantity;
  std::vector<string_view> names;
};

const std::vector<Aliases>& aliases() {
  static const std::vector<Aliases> all = {
      {"time", {"t", "time", "times", "timestamp", "elapsed", "elapsedtime", "zeit", "temps"}},
      {"torque",
       {"torque", "tau", "hubtorque", "motortorque", "appliedtorque", "inputtorque",
        "commandedtorque", "torquecommand", "torquecmd", "moment", "drehmoment"}},
      {"hub_angle",
       {"hubangle", "theta", "angle", "motorangle", "shaftangle", "jointangle", "hub",
        "hubposition", "motorposition", "encoder", "motorencoder", "shaftencoder", "linkangle",
        "armangle", "loadangle", "winkel"}},
      {"hub_velocity",
       {"hubvelocity", "hubspeed", "omega", "thetadot", "dtheta", "angularvelocity",
        "hubangularvelocity", "motorangularvelocity", "angularspeed", "angularrate", "hubrate",
        "velocity", "speed", "motorspeed", "motorvelocity", "tacho", "tachometer"}},
      {"tip_acceleration",
       {"tipacceleration", "tipaccel", "tipacc", "acceleration", "accel", "acc", "accelerometer",
        "endpointacceleration"}},
      {"tip_displacement", {"tipdisplacement", "tipposition", "endpointposition", "displacement"}},
      {"tip_deflection", {"tipdeflection", "tipdefl", "deflection", "defl"}},
  };
  return all;
}

std::string letters_of(string_view name) {
  std::string out;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if (c >= 'a' && c <= 'z') out += c;
  }
  return out;
}

/// A column that may be a quantity.
struct ColumnCandidate {
  std::string quantity;
  std::size_t column = 0;
  bool is_standard = false;  ///< by its standard name
};

std::optional<std::string> standard(string_view base) {
  try {
    return standard_name(base);
  } catch (const arm::InputError&) {
    return std::nullopt;
  }
}

std::vector<ColumnCandidate> candidates_for(const ColumnLabel& label, std::size_t column) {
  std::string base = split_column_name(label.name).base;
  // A field of a structure.
  if (const auto point = base.rfind('.'); point != std::string::npos && !standard(base)) {
    base = base.substr(point + 1);
  }
  if (const auto quantity = standard(base)) {
    if (is_unit_of(*quantity, label.unit)) return {{*quantity, column, true}};
    return {};
  }
  std::vector<ColumnCandidate> found;
  for (const auto& [quantity, names] : aliases()) {
    if (std::ranges::count(names, string_view(letters_of(base))) == 0) continue;
    if (is_unit_of(quantity, label.unit)) {
      found.push_back({quantity, column, false});
    }
  }
  return found;
}

/// The only column of a unit that nothing else has: a time, or a torque.
std::vector<ColumnCandidate> by_unit(std::span<const ColumnLabel> columns,
                                     const std::string& quantity) {
  std::vector<ColumnCandidate> found;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].is_text || columns[i].unit.empty()) continue;
    if (is_unit_of(quantity, columns[i].unit)) {
      found.push_back({quantity, i, false});
    }
  }
  return found;
}

}  // namespace

ColumnGuess guess_columns(std::span<const ColumnLabel> columns, const ColumnMappings& given) {
  ColumnGuess guess{given, {}};
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.name);
  std::vector<bool> is_given(columns.size(), false);
  for (const auto& [quantity, mapping] : given) {
    if (!mapping.expression.empty()) continue;
    if (const auto place = column_place(names, mapping.name)) is_given[*place] = true;
  }
  std::map<std::string, std::vector<ColumnCandidate>> by_quantity;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (is_given[i] || columns[i].is_text) continue;
    for (auto& candidate : candidates_for(columns[i], i)) {
      by_quantity[candidate.quantity].push_back(std::move(candidate));
    }
  }
  for (const char* quantity : {"time", "torque"}) {
    auto& found = by_quantity[quantity];
    if (found.empty()) found = by_unit(columns, quantity);
    std::erase_if(found, [&](const ColumnCandidate& entry) { return is_given[entry.column]; });
  }
  for (auto& [quantity, found] : by_quantity) {
    if (given.contains(quantity) || found.empty()) continue;
    if (std::ranges::count(found, true, &ColumnCandidate::is_standard) > 0) {
      std::erase_if(found, [](const ColumnCandidate& entry) { return !entry.is_standard; });
    }
    if (found.size() > 1) {
      std::vector<std::string> alike;
      for (const auto& entry : found) alike.push_back(columns[entry.column].name);
      guess.notes.push_back(fmt::format("{}: ambiguous ({}); choose with --column {}=NAME",
                                        quantity, fmt::join(alike, " or "), quantity));
      continue;
    }
    const ColumnLabel& label = columns[found.front().column];
    const std::string si_unit(si_unit_of(quantity));
    if (label.unit.empty()) {
      guess.notes.push_back(fmt::format("unit of {} not given; {} assumed", label.name, si_unit));
    }
    guess.mappings[quantity] = {label.name, label.unit.empty() ? si_unit : label.unit,
                                scale_of_unit(quantity, label.unit)};
  }
  return guess;
}

}  // namespace flexarm::measured
