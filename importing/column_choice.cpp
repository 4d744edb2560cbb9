#include "importing/column_choice.hpp"

#include "arm/decimal_comma.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"
#include "measured/files/column_expression.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/delimited_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace flexarm::importing {

namespace {

using arm::InputError;
using measured::ColumnLabel;
using measured::ColumnMapping;

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

/// NAME:UNIT:SCALE as typed; what is not typed is empty.
struct TypedColumn {
  std::size_t place = 0;
  std::string_view name;
  std::string_view unit;
  std::string_view scale;
};

/// NAME, NAME:UNIT or NAME:UNIT:SCALE; a name may hold colons, so that the file tells which it is.
TypedColumn read_column(std::string_view text, std::span<const ColumnLabel> columns) {
  auto place = measured::column_place(columns, text);
  std::string_view name = text;
  std::string_view unit;
  std::string_view scale;
  for (int colons = 1; !place && colons <= 2; ++colons) {
    const auto parts = split_at_colon(text, colons);
    if (!parts) break;
    name = parts->first;
    place = measured::column_place(columns, name);
    unit = parts->second.substr(0, parts->second.find(':'));
    scale = colons == 1 ? std::string_view() : parts->second.substr(unit.size() + 1);
  }
  if (!place) {
    throw measured::unknown_column(measured::column_names(columns), text.substr(0, text.find(':')));
  }
  return {*place, name, unit, scale};
}

/// As the file has it; a name that several columns have is no place.
std::string name_of(const TypedColumn& typed, std::span<const ColumnLabel> columns) {
  const std::string& name = columns[typed.place].name;
  const std::string& path = columns[typed.place].path;
  if (std::ranges::count(columns, name, &ColumnLabel::name) == 1) return name;
  return path.empty() ? std::string(typed.name) : path;
}

/// A scale is in the unit, so that a gear of 1/50 is 1/50 of rpm as of rad/s.
double scale_in_unit(const std::string& quantity, const std::string& unit, double scale,
                     std::vector<std::string>& notes) {
  const double of_unit = measured::scale_of_unit(quantity, unit);
  if (!measured::repeats_conversion(quantity, unit, scale)) return scale * of_unit;
  notes.push_back(fmt::format("{}: SCALE {:.6g} is the conversion of {} itself; applied once",
                              quantity, scale, unit));
  return std::copysign(of_unit, scale);
}

ColumnMapping mapping_of(const std::string& quantity, const TypedColumn& typed,
                         std::span<const ColumnLabel> columns, std::vector<std::string>& notes) {
  ColumnMapping mapping;
  mapping.name = name_of(typed, columns);
  mapping.unit =
      typed.unit.empty() ? columns[typed.place].unit : measured::canonical_unit(typed.unit);
  if (mapping.unit.empty()) mapping.unit = std::string(measured::si_unit_of(quantity));
  mapping.is_scale_stated = !typed.scale.empty();
  if (mapping.is_scale_stated) mapping.scale = read_scale(typed.scale);
  measured::require_valid(quantity, mapping, mapping.is_scale_stated);
  mapping.scale = mapping.is_scale_stated
                      ? scale_in_unit(quantity, mapping.unit, mapping.scale, notes)
                      : measured::scale_of_unit(quantity, mapping.unit);
  return mapping;
}

/// QUANTITY or QUANTITY [UNIT] in front of the first =, the expression behind it.
struct ComputedColumn {
  std::string_view quantity;
  std::string unit;  ///< empty: none typed
  std::string expression;
};

ComputedColumn read_computed(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos) {
    throw InputError("must be QUANTITY=EXPRESSION or QUANTITY [UNIT]=EXPRESSION");
  }
  ComputedColumn computed;
  computed.quantity = measured::trimmed(text.substr(0, equals));
  std::string_view& front = computed.quantity;
  if (const auto open = front.find('['); open != std::string_view::npos && front.ends_with(']')) {
    computed.unit = measured::canonical_unit(front.substr(open + 1, front.size() - open - 2));
    front = measured::trimmed(front.substr(0, open));
  }
  computed.expression = std::string(measured::trimmed(text.substr(equals + 1)));
  return computed;
}

ColumnMapping mapping_of(const std::string& quantity, const ComputedColumn& computed,
                         std::span<const ColumnLabel> columns) {
  ColumnMapping mapping;
  mapping.unit =
      computed.unit.empty() ? std::string(measured::si_unit_of(quantity)) : computed.unit;
  mapping.expression = computed.expression;
  if (mapping.expression.empty()) throw InputError("no expression behind =");
  measured::require_valid(quantity, mapping, false);
  mapping.scale = measured::scale_of_unit(quantity, mapping.unit);
  measured::columns_in(mapping.expression, measured::column_names(columns));
  return mapping;
}

/// "reference=...", "reference [deg]=...".
bool is_of_reference(std::string_view text) {
  const std::string_view front = text.substr(0, std::min(text.find('='), text.size()));
  return front.size() < text.size() &&
         measured::trimmed(front.substr(0, front.find('['))) == measured::kReferenceColumn;
}

/// The sensor and the part in `frequency=...` and `hub_angle.phase=...`; empty for any other.
std::optional<std::pair<std::string, measured::ResponsePart>> typed_part(std::string_view text) {
  using measured::ResponsePart;
  const std::string_view front = text.substr(0, std::min(text.find('='), text.size()));
  if (front == to_string(ResponsePart::frequency)) return std::pair{"", ResponsePart::frequency};
  const auto point = front.rfind('.');
  if (point == std::string_view::npos) return std::nullopt;
  for (const auto part : {ResponsePart::magnitude, ResponsePart::phase, ResponsePart::real,
                          ResponsePart::imaginary, ResponsePart::coherence}) {
    if (front.substr(point + 1) != to_string(part)) continue;
    return std::pair{measured::standard_name(front.substr(0, point)), part};
  }
  return std::nullopt;
}

/// What is typed of the reference.
struct TypedReference {
  std::string option;
  std::string_view text;  ///< NAME:UNIT:SCALE, or QUANTITY [UNIT]=EXPRESSION
  bool is_computed = false;
};

std::optional<TypedReference> typed_reference(const ColumnChoice& choice) {
  std::vector<TypedReference> found;
  if (!choice.reference.empty()) {
    found.push_back(
        {fmt::format("--reference {}", arm::shown(choice.reference)), choice.reference});
  }
  for (const std::string& text : choice.typed) {
    if (!is_of_reference(text)) continue;
    found.push_back({fmt::format("--column {}", arm::shown(text)),
                     std::string_view(text).substr(text.find('=') + 1)});
  }
  for (const std::string& text : choice.computed) {
    if (!is_of_reference(text)) continue;
    found.push_back({fmt::format("--compute {}", arm::shown(text, 200)), text, true});
  }
  if (found.size() > 1) {
    throw InputError(fmt::format("{}: reference given twice", found[1].option));
  }
  if (found.empty()) return std::nullopt;
  return found.front();
}

/// The sensor in whose unit the reference is: of a state space the first that has the unit.
arm::Sensor sensor_of_reference(const arm::Controller& controller, std::string_view unit) {
  const auto& sensors = controller.sensors;
  if (std::holds_alternative<arm::PidController>(controller.law)) return sensors.front();
  const auto found = std::ranges::find_if(sensors, [&](const arm::Sensor& sensor) {
    return measured::is_unit_of(arm::to_string(sensor), unit);
  });
  return found == sensors.end() ? sensors.front() : *found;
}

void add_mapping(measured::ColumnMappings& mappings, const std::string& quantity,
                 const ColumnMapping& mapping) {
  if (!mappings.emplace(quantity, mapping).second) {
    throw InputError(fmt::format("{} given twice", quantity));
  }
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
                      "0.202*pi/180{}",
                      arm::shown(text), arm::decimal_comma_hint(text)));
    }
    scale = divides ? scale / *number : scale * *number;
    if (end == rest.size()) return scale;
    divides = rest[end] == '/';
    rest.remove_prefix(end + 1);
  }
}

measured::ColumnMappings ColumnChoice::mappings(std::span<const ColumnLabel> columns,
                                                std::vector<std::string>& notes) const {
  measured::ColumnMappings mappings;
  for (const auto& text : typed) {
    if (is_of_reference(text) || typed_part(text)) continue;
    try {
      const auto equals = text.find('=');
      if (equals == std::string::npos) {
        throw InputError("must be QUANTITY=NAME, QUANTITY=NAME:UNIT or QUANTITY=NAME:UNIT:SCALE");
      }
      const std::string quantity =
          measured::standard_name(std::string_view(text).substr(0, equals));
      const auto column = read_column(std::string_view(text).substr(equals + 1), columns);
      add_mapping(mappings, quantity, mapping_of(quantity, column, columns, notes));
    } catch (const InputError& error) {
      throw InputError(fmt::format("--column {}: {}", arm::shown(text), error.what()));
    }
  }
  const auto add_computed = [&](const char* option, const std::string& text) {
    try {
      const ComputedColumn column = read_computed(text);
      const std::string quantity = measured::standard_name(column.quantity);
      add_mapping(mappings, quantity, mapping_of(quantity, column, columns));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", option, error.what()));
    }
  };
  for (const auto& text : computed) {
    if (is_of_reference(text)) continue;
    add_computed(fmt::format("--compute {}", arm::shown(text, 200)).c_str(), text);
  }
  if (!torque.empty()) add_computed("--torque", "torque=" + torque);
  return mappings;
}

std::vector<measured::PartColumn> ColumnChoice::response_parts(
    std::span<const ColumnLabel> columns) const {
  std::vector<measured::PartColumn> parts;
  for (const auto& text : typed) {
    try {
      const auto part = typed_part(text);
      if (!part) continue;
      const auto column = read_column(std::string_view(text).substr(text.find('=') + 1), columns);
      if (!column.scale.empty()) throw InputError("a part of a response has no SCALE");
      // In the spelling of a header, by which its sensor is known.
      std::string response = part->first;
      if (!response.empty()) {
        response += fmt::format(" [{}]", measured::si_unit_of(part->first));
      }
      const std::string& told = columns[column.place].unit;
      parts.push_back({part->second, std::move(response), column.place,
                       column.unit.empty() ? told : measured::canonical_unit(column.unit)});
    } catch (const InputError& error) {
      throw InputError(fmt::format("--column {}: {}", arm::shown(text), error.what()));
    }
  }
  return parts;
}

std::vector<std::size_t> ColumnChoice::left_out_places(std::span<const ColumnLabel> columns) const {
  const std::vector<std::string> names = measured::column_names(columns);
  std::vector<std::size_t> places;
  for (const auto& name : left_out) {
    const auto place = measured::column_place(names, name);
    if (!place) {
      throw InputError(
          fmt::format("--leave-out: {}", measured::unknown_column(names, name).what()));
    }
    places.push_back(*place);
  }
  return places;
}

measured::OwnRates ColumnChoice::own_rates() const {
  constexpr std::array<std::pair<std::string_view, measured::Between>, 3> kWords = {
      {{"hold", measured::Between::hold},
       {"linear", measured::Between::linear},
       {"rows", measured::Between::rows}}};
  measured::OwnRates rates;
  for (const std::string& text : own_rate) {
    const std::string option = fmt::format("--own-rate {}", arm::shown(text));
    const auto equals = std::min(text.find('='), text.size());
    const auto word =
        std::ranges::find(kWords, std::string_view(text).substr(std::min(equals + 1, text.size())),
                          [](const auto& entry) { return entry.first; });
    if (word == kWords.end()) {
      throw InputError(option + ": must be QUANTITY=hold, QUANTITY=linear or QUANTITY=rows");
    }
    std::string quantity = text.substr(0, equals);
    try {
      if (quantity != measured::kReferenceColumn) quantity = measured::standard_name(quantity);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", option, error.what()));
    }
    if (!rates.emplace(quantity, word->second).second) {
      throw InputError(fmt::format("{}: {} given twice", option, quantity));
    }
  }
  return rates;
}

std::string ColumnChoice::reference_option() const {
  const auto typed_one = typed_reference(*this);
  return typed_one ? typed_one->option : "";
}

std::optional<std::size_t> ColumnChoice::reference_place(
    std::span<const ColumnLabel> columns) const {
  const auto typed_one = typed_reference(*this);
  if (typed_one->is_computed) return std::nullopt;
  try {
    return read_column(typed_one->text, columns).place;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", typed_one->option, error.what()));
  }
}

ReferenceColumn ColumnChoice::reference_column(std::span<const ColumnLabel> columns,
                                               const measured::ColumnMappings& mappings,
                                               const arm::Controller& controller,
                                               std::vector<std::string>& notes) const {
  const auto typed_one = typed_reference(*this);
  try {
    if (typed_one->is_computed) {
      const ComputedColumn computed_one = read_computed(typed_one->text);
      const arm::Sensor sensor = sensor_of_reference(controller, computed_one.unit);
      return {sensor, mapping_of(arm::to_string(sensor), computed_one, columns)};
    }
    const TypedColumn column = read_column(typed_one->text, columns);
    const std::string& told = columns[column.place].unit;
    const auto of_sensor = mappings.find(arm::to_string(controller.sensors.front()));
    const bool is_like_sensor =
        column.unit.empty() && column.scale.empty() && of_sensor != mappings.end() &&
        of_sensor->second.expression.empty() && (told.empty() || told == of_sensor->second.unit);
    if (is_like_sensor) {
      ColumnMapping mapping = of_sensor->second;
      mapping.name = name_of(column, columns);
      return {controller.sensors.front(), std::move(mapping)};
    }
    const std::string unit = column.unit.empty() ? told : measured::canonical_unit(column.unit);
    const arm::Sensor sensor = sensor_of_reference(controller, unit);
    return {sensor, mapping_of(arm::to_string(sensor), column, columns, notes)};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", typed_one->option, error.what()));
  }
}

void ColumnChoice::set_time_unit(measured::ColumnMappings& mappings) const {
  const auto time = mappings.find("time");
  if (time_unit.empty() || time == mappings.end()) return;
  if (measured::is_unit_of("time", time_unit)) {
    time->second.unit = measured::canonical_unit(time_unit);
    time->second.scale = measured::scale_of_unit("time", time->second.unit);
    return;
  }
  const auto names = measured::unit_names("time");
  throw InputError(fmt::format("--time-unit {}: must be {}{}", arm::shown(time_unit),
                               fmt::join(names, " or "), arm::did_you_mean(time_unit, names)));
}

}  // namespace flexarm::importing
