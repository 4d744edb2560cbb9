#include "measured/files/foreign_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/file_kind.hpp"
#include "measured/files/foreign_mat.hpp"
#include "measured/files/json_table.hpp"
#include "measured/files/long_table.hpp"
#include "measured/files/mat_file.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/response_columns.hpp"
#include "measured/files/response_unit.hpp"
#include "measured/files/split_seconds.hpp"
#include "measured/files/universal_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;

std::string told(const std::string& text) {
  return text == "NONE" || text == "none" ? "" : text;
}

/// "node 3 -z", where a function tells.
std::string place_of(const UniversalPlace& place) {
  constexpr std::array<const char*, 7> kDirections = {"", "x", "y", "z", "rx", "ry", "rz"};
  const int axis = std::abs(place.direction);
  std::string text = fmt::format("node {}", place.node);
  if (axis > 0 && axis < static_cast<int>(kDirections.size())) {
    text += fmt::format(" {}{}", place.direction < 0 ? "-" : "+",
                        kDirections[static_cast<std::size_t>(axis)]);
  }
  return text;
}

/// A name that no other function has: the first of its ID line, its response's entity and its
/// axis' label that is told, with the place in the structure where others share it.
std::vector<std::string> names_of(const std::vector<const UniversalFunction*>& functions) {
  std::vector<std::string> names;
  for (const auto* function : functions) {
    std::string name = told(function->id[0]);
    if (name.empty()) name = told(function->response.entity);
    if (name.empty()) name = told(function->ordinate_axis.label);
    names.push_back(name.empty() ? place_of(function->response) : name);
  }
  const std::vector<std::string> plain = names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::count(plain, plain[i]) > 1) {
      names[i] += ", " + place_of(functions[i]->response);
    }
  }
  const std::vector<std::string> placed = names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto before =
        std::count(placed.begin(), placed.begin() + static_cast<std::ptrdiff_t>(i), placed[i]);
    if (before > 0) names[i] += fmt::format(" ({})", before + 1);
  }
  return names;
}

std::string unit_of_axis(const UniversalAxis& axis, const std::string& name) {
  const std::string unit = told(axis.units);
  return unit.empty() ? split_column_name(name).unit : canonical_unit(unit);
}

void add_signals(const std::vector<const UniversalFunction*>& functions, ForeignFile& file) {
  if (functions.empty()) return;
  const auto names = names_of(functions);
  const UniversalFunction& first = *functions.front();
  const std::string unit = told(first.abscissa_axis.units);
  file.table.columns.push_back(
      {"time [s]", unit.empty() ? "s" : canonical_unit(unit), first.abscissa});
  if (unit.empty()) file.table.assumptions.emplace_back("the abscissa is in s");
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const UniversalFunction& function = *functions[i];
    if (!function.imaginary.empty()) {
      file.left_out.push_back(fmt::format("{}: complex time signal", names[i]));
    } else if (function.abscissa != first.abscissa) {
      file.left_out.push_back(
          fmt::format("{}: time axis differs from that of {}", names[i], names.front()));
    } else {
      file.table.columns.push_back(
          {names[i], unit_of_axis(function.ordinate_axis, names[i]), function.real});
    }
  }
}

/// Hz in one of the frequency axis' unit, which is Hz where it is not told.
double hertz_of(const UniversalAxis& axis, const std::string& name, ForeignFile& file) {
  const std::string unit = canonical_unit(told(axis.units));
  if (unit.empty()) {
    file.table.assumptions.push_back(
        fmt::format("unit of the frequencies of {} not given; Hz assumed", arm::shown(name)));
    return 1.0;
  }
  const double hertz = hertz_in_one(unit);
  if (hertz > 0.0) return hertz;
  throw no_unit_of_frequencies(arm::shown(name), unit);
}

/// Says where the node's direction is against the axis, and where only data set 164 has units.
void note_conventions(const UniversalFile& universal,
                      const std::vector<const UniversalFunction*>& functions, ForeignFile& file) {
  const auto names = names_of(functions);
  std::vector<std::string> without_unit;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const UniversalFunction& function = *functions[i];
    const bool is_response = function.type == kUniversalFrequencyResponse;
    if ((function.response.direction < 0) != (is_response && function.reference.direction < 0)) {
      file.table.assumptions.push_back(fmt::format(
          "{}: {}{}; the sign of a direction is not applied, a negative SCALE of --column applies "
          "it",
          arm::shown(names[i]), place_of(function.response),
          is_response ? " per " + place_of(function.reference) : ""));
    }
    if (unit_of_axis(function.ordinate_axis, names[i]).empty()) without_unit.push_back(names[i]);
  }
  if (universal.units.empty() || without_unit.empty()) return;
  file.table.assumptions.push_back(
      fmt::format("data set 164 has units, {}, which are not applied; units not given: {}; state "
                  "them with --column QUANTITY=NAME:UNIT",
                  arm::shown(universal.units), shown_names(without_unit)));
}

void add_responses(const std::vector<const UniversalFunction*>& functions, ForeignFile& file) {
  const auto names = names_of(functions);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const UniversalFunction& function = *functions[i];
    const ResponseUnit unit = split_response_unit(unit_of_axis(function.ordinate_axis, names[i]));
    ForeignResponse response{
        names[i],
        unit.unit,
        unit.per.empty() ? canonical_unit(told(function.denominator_axis.units)) : unit.per,
        function.abscissa,
        {},
        std::vector<double>(function.abscissa.size(), kUnknown)};
    if (function.imaginary.empty()) {
      throw InputError(fmt::format(
          "{}: frequency response of real numbers, a magnitude without phase; must be complex",
          arm::shown(names[i])));
    }
    const double factor = hertz_of(function.abscissa_axis, names[i], file);
    for (auto& frequency : response.frequency_Hz) frequency *= factor;
    for (std::size_t k = 0; k < function.real.size(); ++k) {
      response.response.emplace_back(function.real[k], function.imaginary[k]);
    }
    file.responses.push_back(std::move(response));
  }
}

/// A coherence belongs to the response before it of the same first ID line and response.
void add_coherences(const UniversalFile& universal, ForeignFile& file) {
  const UniversalFunction* last = nullptr;
  std::size_t responses = 0;
  for (const auto& function : universal.functions) {
    if (function.type == kUniversalFrequencyResponse) {
      last = &function;
      ++responses;
    }
    if (function.type != kUniversalCoherence) continue;
    if (last == nullptr || !(last->response == function.response)) {
      file.left_out.push_back(
          fmt::format("{}: coherence without a frequency response", function.id[0]));
      continue;
    }
    ForeignResponse& response = file.responses[responses - 1];
    for (std::size_t k = 0; k < function.abscissa.size(); ++k) {
      const auto at = std::ranges::lower_bound(last->abscissa, function.abscissa[k]);
      if (at == last->abscissa.end() || *at != function.abscissa[k]) continue;
      response.coherence[static_cast<std::size_t>(at - last->abscissa.begin())] = function.real[k];
    }
  }
}

ForeignFile universal_contents(std::string_view bytes, const std::string& file_name) {
  const UniversalFile universal = parse_universal_file(bytes, file_name);
  ForeignFile file;
  file.format = ForeignFormat::universal;
  std::vector<const UniversalFunction*> signals;
  std::vector<const UniversalFunction*> responses;
  for (const auto& function : universal.functions) {
    if (function.type == kUniversalTimeResponse) {
      signals.push_back(&function);
    } else if (function.type == kUniversalFrequencyResponse) {
      responses.push_back(&function);
    } else if (function.type != kUniversalCoherence) {
      file.left_out.push_back(
          fmt::format("{}: a function of type {}", function.id[0], function.type));
    }
  }
  try {
    add_signals(signals, file);
    add_responses(responses, file);
  } catch (const InputError& error) {
    throw arm::located(error, file_name, 0);
  }
  add_coherences(universal, file);
  note_conventions(universal, signals, file);
  note_conventions(universal, responses, file);
  for (const auto& mode : universal.modes) {
    const bool is_told = mode.pole && std::ranges::count(file.modes, *mode.pole) > 0;
    if (mode.pole && !is_told) file.modes.push_back(*mode.pole);
    file.left_out.push_back(mode.left_out);
  }
  for (const auto& number : universal.passed_over) {
    file.left_out.push_back("data set " + number);
  }
  return file;
}

/// Responses that stand in columns of the table; a frequency record names a sensor in each row.
void add_column_responses(ForeignFile& file) {
  const auto& columns = file.table.columns;
  if (std::ranges::count(columns, "sensor", &ForeignColumn::name) > 0) return;
  try {
    ResponseColumns made = responses_in(file.table);
    std::ranges::move(made.responses, std::back_inserter(file.responses));
    std::ranges::move(made.notes, std::back_inserter(file.table.assumptions));
    file.incomplete_response = std::move(made.incomplete);
  } catch (const InputError& error) {
    file.response_fault = error.what();  // the user may state the parts, or read signals in time
  }
}

/// "-1" alone is the first line of a universal file.
bool is_universal(std::string_view bytes) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const auto end = std::min(bytes.find_first_of("\r\n", first), bytes.size());
  const std::string_view line = bytes.substr(first, end - first);
  return line.substr(0, line.find_last_not_of(" \t") + 1) == "-1";
}

/// The factor into SI of a mapped response, N m and all.
double scale_of(const ForeignResponse& response, const std::string& sensor,
                const ColumnMapping& mapping, double& divisor) {
  const Unit unit = unit_of(sensor, mapping.unit).value_or(Unit{mapping.unit});
  const bool is_to_torque = is_unit_of("torque", response.per);
  if (!is_to_torque && !mapping.is_scale_stated) {
    throw InputError(fmt::format(
        "{0}: a response to {1}, not to a torque; state its scale in {1} per N m, as in --column "
        "'{2}={0}:{3}:SCALE'",
        arm::shown(response.name), arm::shown(response.per), sensor, arm::shown(mapping.unit)));
  }
  const Unit torque = unit_of("torque", response.per).value_or(Unit{response.per});
  divisor = unit.divisor * torque.factor * scale_of_unit("torque", response.per);
  return mapping.scale * unit.factor * torque.divisor;
}

/// The contents of a file of any format; `path` is that of the same file.
ForeignFile foreign_contents(const std::string& bytes, const std::string& name,
                             const std::filesystem::path& path) {
  ForeignFile file;
  if (is_mat_file(bytes)) {
    file = mat_contents(path);
  } else if (is_json(bytes)) {
    // The schema of a result; numbers of one are no log.
    if (bytes.find("\"flexarm.") != std::string::npos) {
      const auto known = recognise_file(bytes);
      if (known && known->kind == FileKind::result) throw InputError("a result");
    }
    JsonTable json = parse_json_table(bytes, name);
    file.format = ForeignFormat::json;
    file.table = std::move(json.table);
    file.left_out = std::move(json.left_out);
  } else if (is_universal(bytes)) {
    file = universal_contents(bytes, name);
  } else {
    file.table = parse_foreign_table(bytes, name);
  }
  complete_whole_seconds(file.table);
  try {
    file.table = without_long_form(std::move(file.table));
  } catch (const InputError& error) {
    throw arm::located(error, name, 0);
  }
  add_column_responses(file);
  if (file.table.columns.empty() && file.responses.empty() && file.modes.empty()) {
    throw InputError(fmt::format("{}: {} without time signals, frequency responses or modes", name,
                                 to_string(file.format)));
  }
  return file;
}

}  // namespace

const char* to_string(ForeignFormat format) {
  switch (format) {
    case ForeignFormat::universal:
      return "universal file (data set 58)";
    case ForeignFormat::matlab4:
      return "MATLAB 4 file";
    case ForeignFormat::matlab5:
      return "MATLAB 5 file";
    case ForeignFormat::matlab73:
      return "MATLAB 7.3 file";
    case ForeignFormat::json:
      return "JSON";
    default:
      return "delimited text";
  }
}

ForeignFile read_foreign_file(const std::filesystem::path& path) {
  return read_file_as(FileKind::log, path, kLargestRecord_bytes,
                      [&](const std::string& bytes, const std::string& name) {
                        return foreign_contents(bytes, name, path);
                      });
}

FrequencyRecord frequency_record_of(const ForeignFile& file, const ColumnMappings& mappings,
                                    const std::string& file_name) {
  FrequencyRecord record;
  try {
    const std::vector<std::string> names = column_names(file.responses);
    if (!file.response_fault.empty()) throw InputError(file.response_fault);
    if (names.empty()) {
      throw InputError(
          "no frequency responses; signals in time become a measurement with  flexarm import");
    }
    for (const auto& [quantity, mapping] : mappings) {
      if (!sensor_of(quantity)) {
        throw InputError(fmt::format("{}: frequency responses have sensors only", quantity));
      }
      if (std::ranges::count(names, mapping.name) == 1) continue;
      throw InputError(fmt::format("response {}: not in the file; it has {}",
                                   arm::shown(mapping.name), shown_names(names)));
    }
    for (const auto& response : file.responses) {
      ColumnMappings own;
      for (const auto& entry : mappings) {
        if (entry.second.name == response.name) own.insert(entry);
      }
      if (own.empty()) own = standard_mapping(response.name);
      for (const auto& [quantity, mapping] : own) {
        const auto sensor = sensor_of(quantity);
        if (!sensor) continue;
        if (std::ranges::count(record.channels, *sensor, &FrequencyChannel::sensor) > 0) {
          throw InputError(fmt::format("{}: given twice", quantity));
        }
        double divisor = 1.0;
        const double factor = scale_of(response, quantity, mapping, divisor);
        FrequencyChannel channel{*sensor, response.frequency_Hz, response.response,
                                 response.coherence};
        for (auto& value : channel.response) value = value * factor / divisor;
        record.channels.push_back(std::move(channel));
      }
    }
    if (record.channels.empty()) {
      throw InputError(
          fmt::format("no response is mapped to a sensor; responses: {}; assign one with --column "
                      "hub_angle=NAME:UNIT:SCALE",
                      shown_names(names)));
    }
    format_frequency_record(record);  // throws for what is out of range
  } catch (const InputError& error) {
    throw arm::located(error, file_name, 0);
  }
  return record;
}

}  // namespace flexarm::measured
