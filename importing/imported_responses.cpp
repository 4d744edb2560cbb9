#include "importing/imported_responses.hpp"

#include "arm/input_error.hpp"
#include "importing/unit_contradictions.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/missing_signs.hpp"
#include "measured/files/name_change.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::importing {

namespace {

using arm::InputError;
using measured::ColumnLabel;
using measured::ForeignFile;

std::string response_names(const ForeignFile& file) {
  std::vector<std::string> names;
  for (const auto& response : file.responses) {
    for (const auto column : response.columns) names.push_back(file.table.columns[column].name);
  }
  return measured::shown_names(names);
}

/// Responses in columns are typed by any of these: each such name becomes that of the response.
measured::ColumnMappings mappings_by_columns(const ForeignFile& file, const ColumnChoice& choice,
                                             ImportedFile& imported) {
  auto columns = measured::labels_of(file.table);
  const auto response_of = [&](std::size_t column) {
    return std::ranges::find_if(file.responses, [&](const auto& response) {
      return std::ranges::count(response.columns, column) > 0;
    });
  };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto response = response_of(i);
    columns[i].unit = response == file.responses.end() ? "" : response->unit;
  }
  const std::vector<std::string> names = measured::column_names(columns);
  auto mappings = choice.mappings(columns, imported.assumptions);
  std::ranges::move(unit_contradictions(mappings, columns), std::back_inserter(imported.warnings));
  for (auto& [quantity, mapping] : mappings) {
    const auto response = response_of(*measured::column_place(names, mapping.name));
    if (response == file.responses.end()) {
      throw InputError(fmt::format("--column {}={}: no part of a response; those are in {}",
                                   quantity, arm::shown(mapping.name), response_names(file)));
    }
    mapping.name = response->name;
  }
  return mappings;
}

/// The only response of a file that does not tell of what it is: by its unit, or that of the hub.
void assume_sensor(const ForeignFile& file, measured::ColumnMappings& mappings,
                   std::vector<std::string>& warnings) {
  if (file.responses.size() != 1 || !mappings.empty()) return;
  const auto& response = file.responses.front();
  const std::string base = measured::split_column_name(response.name).base;
  if (const auto change = measured::change_in(base); change && response.columns.empty()) {
    throw InputError(
        fmt::format("response {0}: its name has {1}; state it with --column 'SENSOR={2}:UNIT:SCALE'"
                    ", SCALE -1 where it is the negative of the sensor",
                    arm::shown(response.name), arm::shown(change->mark), arm::shown(base)));
  }
  for (const char* sensor : {"hub_angle", "hub_velocity", "tip_acceleration"}) {
    if (!measured::is_unit_of(sensor, response.unit)) continue;
    const std::string unit(response.unit.empty() ? measured::si_unit_of(sensor)
                                                 : std::string_view(response.unit));
    mappings[sensor] = {response.name, unit, measured::scale_of_unit(sensor, response.unit)};
    warnings.push_back(fmt::format(
        "{} is taken as {} in {} per {}; if it is another, state it with --column 'SENSOR={}:UNIT'",
        arm::shown(response.name), sensor, unit, response.per.empty() ? "N m" : response.per,
        arm::shown(response.name)));
    return;
  }
}

/// Leaves out the lines of the response that hold no measurement, and warns of what may be none.
void check_lines(const measured::ForeignTable& table, measured::ForeignResponse& response,
                 const std::string& sensor, ImportedFile& imported) {
  const auto warn = [&](const std::vector<std::string>& doubts) {
    imported.warnings.insert(imported.warnings.end(), doubts.begin(), doubts.end());
  };
  for (const auto place : response.columns) {
    warn(measured::doubtful_signs(table.columns[place].values, table.columns[place].name, sensor));
  }
  if (response.columns.empty()) warn(doubtful_parts(response.response, sensor));
  const std::size_t lines = response.response.size();
  std::size_t kept = 0;
  for (std::size_t line = 0; line < lines; ++line) {
    const auto value = response.response[line];
    const bool is_read = measured::is_reading(response.frequency_Hz[line]) &&
                         measured::is_reading(value.real()) && measured::is_reading(value.imag());
    if (!is_read) continue;
    response.frequency_Hz[kept] = response.frequency_Hz[line];
    response.coherence[kept] = response.coherence[line];
    response.response[kept++] = value;
  }
  if (kept == lines) return;
  response.frequency_Hz.resize(kept);
  response.coherence.resize(kept);
  response.response.resize(kept);
  imported.assumptions.push_back(
      fmt::format("{}: {} of {} lines left out: not finite, or an instrument's sign of no "
                  "measurement",
                  sensor, lines - kept, lines));
}

}  // namespace

void read_responses(ForeignFile& file, const FileChoice& choice, ImportedFile& imported) {
  if (choice.columns.is_for_signals() || choice.controller) {
    throw InputError(
        "--compute, --torque, --time-unit, --reference, --own-rate: only for time signals");
  }
  std::vector<ColumnLabel> responses;
  for (const auto& response : file.responses) responses.push_back({response.name, response.unit});
  measured::ColumnMappings typed;
  if (file.responses.front().columns.empty()) {
    typed = choice.columns.mappings(responses, imported.assumptions);
    std::ranges::move(unit_contradictions(typed, responses), std::back_inserter(imported.warnings));
  } else {
    typed = mappings_by_columns(file, choice.columns, imported);
  }
  auto to_guess = responses;
  for (const auto place : choice.columns.left_out_places(responses)) {
    to_guess[place].is_text = true;
  }
  auto guess = measured::guess_columns(to_guess, typed);
  // Time and torque are no responses.
  std::erase_if(guess.mappings,
                [](const auto& entry) { return !measured::sensor_of(entry.first).has_value(); });
  assume_sensor(file, guess.mappings, imported.warnings);
  imported.assumptions.insert(imported.assumptions.end(), guess.notes.begin(), guess.notes.end());
  imported.columns = std::move(guess.mappings);
  for (const auto& [sensor, mapping] : imported.columns) {
    for (auto& response : file.responses) {
      if (response.name == mapping.name) check_lines(file.table, response, sensor, imported);
    }
  }
  const auto is_read = [&](const std::string& name) {
    return std::ranges::any_of(imported.columns,
                               [&](const auto& entry) { return entry.second.name == name; });
  };
  for (const auto& response : responses) {
    if (!is_read(response.name)) imported.not_used.push_back(response.name);
  }
  imported.data = frequency_record_of(file, imported.columns, arm::shown(imported.file));
}

std::vector<std::string> doubtful_parts(std::span<const std::complex<double>> response,
                                        const std::string& what) {
  std::vector<std::string> doubts;
  for (const bool is_real : {true, false}) {
    std::vector<double> values;
    for (const auto& value : response) values.push_back(is_real ? value.real() : value.imag());
    std::ranges::move(measured::doubtful_signs(values, is_real ? "re" : "im", what),
                      std::back_inserter(doubts));
  }
  return doubts;
}

void take_typed_responses(ForeignFile& file, const FileChoice& choice) {
  const auto labels = measured::labels_of(file.table);
  const auto parts = choice.columns.response_parts(labels);
  if (parts.empty()) {
    const bool is_for_time = choice.kind == measured::RunKind::time;
    if (!is_for_time && !file.response_fault.empty()) throw InputError(file.response_fault);
    return;
  }
  for (const auto& part : parts) {
    const ColumnLabel& label = labels[part.column];
    if (label.unit == part.unit || !measured::is_canonical_unit(label.unit)) continue;
    file.table.assumptions.push_back(
        fmt::format("{}: the file tells {} of {}, but it is read in {}, as stated",
                    to_string(part.part), label.unit, arm::shown(label.name), part.unit));
  }
  file.response_fault.clear();
  auto made = measured::responses_of(file.table, parts);
  file.responses = std::move(made.responses);
  for (auto& response : file.responses) {
    if (response.unit.empty()) response.unit = measured::split_column_name(response.name).unit;
  }
  std::ranges::move(made.notes, std::back_inserter(file.table.assumptions));
}

}  // namespace flexarm::importing
