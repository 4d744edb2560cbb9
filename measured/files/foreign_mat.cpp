#include "measured/files/foreign_mat.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/json_times.hpp"
#include "measured/files/mat_file.hpp"
#include "measured/files/mat_names.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/record_export.hpp"
#include "measured/files/response_unit.hpp"
#include "measured/files/signal_factors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;

/// A matrix of more columns is no set of signals.
constexpr std::size_t kMostColumns = 64;

/// A variable by its name; null when it is not there or of another kind.
template <class T>
const T* find(const std::vector<MatVariable>& variables, std::string_view name) {
  const auto found = std::ranges::find(variables, name, &MatVariable::name);
  return found == variables.end() ? nullptr : std::get_if<T>(&found->value);
}

template <class T>
const T& require(const std::vector<MatVariable>& variables, const std::string& name) {
  const T* value = find<T>(variables, name);
  if (value == nullptr) throw InputError(fmt::format("variable {}: missing in a record", name));
  return *value;
}

/// Headers of the sensors: "hub_angle [rad]".
std::vector<std::string> headers_of(const std::vector<MatVariable>& variables) {
  const auto& sensors = require<MatStrings>(variables, "sensors");
  const auto& units = require<MatStrings>(variables, "units");
  if (units.size() != sensors.size()) throw InputError("variable units: not as many as sensors");
  if (sensors.size() > kMostRecordColumns) {
    throw InputError(
        fmt::format("{} sensors; at most {} are read", sensors.size(), kMostRecordColumns));
  }
  std::vector<std::string> headers;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    headers.push_back(fmt::format("{} [{}]", sensors[i], units[i]));
  }
  return headers;
}

void read_time_variables(const std::vector<MatVariable>& variables, ForeignFile& file) {
  auto& columns = file.table.columns;
  columns.push_back({"time [s]", "s", require<MatMatrix>(variables, "time_s").values});
  columns.push_back({"torque [N m]", "N m", require<MatMatrix>(variables, "torque_N_m").values});
  const auto headers = headers_of(variables);
  const auto& values = require<MatMatrix>(variables, "values");
  if (values.columns != headers.size()) {
    throw InputError("variable values: not as many columns as sensors");
  }
  for (std::size_t j = 0; j < headers.size(); ++j) {
    const auto begin = values.values.begin() + static_cast<std::ptrdiff_t>(j * values.rows);
    columns.push_back({headers[j],
                       split_column_name(headers[j]).unit,
                       {begin, begin + static_cast<std::ptrdiff_t>(values.rows)}});
  }
  if (const auto* reference = find<MatMatrix>(variables, "reference")) {
    const auto& unit = require<std::string>(variables, "reference_unit");
    columns.push_back({fmt::format("{} [{}]", kReferenceColumn, unit), unit, reference->values});
  }
}

void read_frequency_variables(const std::vector<MatVariable>& variables, ForeignFile& file) {
  const auto headers = headers_of(variables);
  for (std::size_t k = 0; k < headers.size(); ++k) {
    const auto numbered = [&](const char* name) { return fmt::format("{}_{}", name, k + 1); };
    ForeignResponse response{headers[k],
                             split_column_name(headers[k]).unit,
                             "N m",
                             require<MatMatrix>(variables, numbered("frequency_Hz")).values,
                             require<MatComplexMatrix>(variables, numbered("response")).values,
                             require<MatMatrix>(variables, numbered("coherence")).values};
    if (response.response.size() != response.frequency_Hz.size() ||
        response.coherence.size() != response.frequency_Hz.size()) {
      throw InputError(fmt::format("{}: vectors of unlike length", arm::shown(headers[k])));
    }
    file.responses.push_back(std::move(response));
  }
}

/// Behind the name of a variable: "" of a vector, "(:,2)" of a matrix of columns, "(2,:)" of one of
/// rows, which has more columns than rows; none of what is no set of signals.
template <class T>
std::vector<std::string> signal_suffixes(const MatArray<T>& matrix) {
  const std::size_t shorter = std::min(matrix.rows, matrix.columns);
  const std::size_t longer = std::max(matrix.rows, matrix.columns);
  if (shorter == 0 || longer < 2 || shorter > kMostColumns) return {};
  if (shorter == 1) return {""};
  std::vector<std::string> suffixes;
  for (std::size_t j = 1; j <= shorter; ++j) {
    suffixes.push_back(
        fmt::format(fmt::runtime(matrix.rows < matrix.columns ? "({},:)" : "(:,{})"), j));
  }
  return suffixes;
}

/// The signal with that number among the columns or rows of a matrix, or a vector.
template <class T>
std::vector<T> signal_of(const MatArray<T>& matrix, std::size_t number) {
  const std::size_t shorter = std::min(matrix.rows, matrix.columns);
  const bool are_rows = shorter > 1 && matrix.rows < matrix.columns;
  std::vector<T> values;
  for (std::size_t k = 0; k < matrix.values.size() / shorter; ++k) {
    values.push_back(are_rows ? matrix(number, k)
                              : matrix.values[number * (matrix.values.size() / shorter) + k]);
  }
  return values;
}

/// The first vector of frequencies.
struct Frequencies {
  std::string path;
  std::string unit;            ///< Hz, kHz, rad/s or rpm
  bool is_unit_told = true;    ///< by the name or beside it; else Hz is assumed
  std::vector<double> values;  ///< in that unit
};

std::optional<Frequencies> frequencies_in(const std::vector<MatVariable>& variables,
                                          const MatNames& names) {
  for (const auto& variable : variables) {
    const auto* matrix = std::get_if<MatMatrix>(&variable.value);
    const auto of_name = unit_of_frequency_name(variable.name);
    if (matrix == nullptr || !of_name || std::min(matrix->rows, matrix->columns) != 1) continue;
    const std::string told = names.of(variable.name, {""}).front().unit;
    const std::string unit = !told.empty() ? told : of_name->empty() ? "Hz" : *of_name;
    if (hertz_in_one(unit) > 0.0) {
      return Frequencies{variable.name, unit, !told.empty() || !of_name->empty(), matrix->values};
    }
    if (names.told_frequency_unit(variable.name).empty()) continue;  // a force in N
    throw no_unit_of_frequencies(arm::shown(variable.name), told);
  }
  return std::nullopt;
}

/// The unit rad/s beside a response and a frequency of a structure may be of either.
void require_clear_unit(const Frequencies& frequencies, const MatSignalName& signal) {
  const bool is_of_name = !split_column_name(mat_field(signal.path)).unit.empty();
  if (frequencies.is_unit_told || is_of_name || signal.unit != "rad/s" ||
      owner_of(signal.path).empty() || owner_of(signal.path) != owner_of(frequencies.path)) {
    return;
  }
  throw InputError(fmt::format(
      "{}: unit not given, and the rad/s beside it may be that of {}; save the unit of the "
      "frequencies as a text FrequencyUnit beside them, Hz or rad/s",
      arm::shown(frequencies.path), arm::shown(signal.path)));
}

/// Whether it is more than a number or a text.
bool is_large(const MatVariable& variable) {
  const auto* real = std::get_if<MatMatrix>(&variable.value);
  const auto* complex = std::get_if<MatComplexMatrix>(&variable.value);
  return (real != nullptr && real->values.size() > 1) ||
         (complex != nullptr && complex->values.size() > 1);
}

/// A time that several structures have is read once.
void add_signal(const MatSignalName& signal, std::vector<double> values, ForeignFile& file) {
  const auto is_time = [](std::string_view name) {
    const std::string field = mat_field(name);
    return field == "time" || field == "t";
  };
  for (const auto& column : file.table.columns) {
    if (!is_time(signal.name) || !is_time(column.name) || column.values != values) continue;
    file.left_out.push_back(fmt::format("{}: the same times as {}", signal.path, column.name));
    return;
  }
  ForeignColumn column{signal.name, signal.unit, std::move(values)};
  column.path = signal.path;
  file.table.columns.push_back(std::move(column));
}

/// Names that several signals have tell them not apart: their paths do.
void use_paths_of_namesakes(ForeignTable& table) {
  std::map<std::string, std::size_t> counts;
  for (const auto& column : table.columns) ++counts[column.name];
  std::vector<std::string> told;
  for (auto& column : table.columns) {
    if (counts[column.name] > 1) column.name = column.path;
    if (column.name != column.path) told.push_back(column.name + " is " + column.path);
  }
  if (told.empty()) return;
  table.assumptions.push_back(
      fmt::format("names are those of the labels in the file: {}", shown_names(told)));
}

void read_other_variables(std::vector<MatVariable> all, ForeignFile& file) {
  const std::vector<MatVariable> variables = gathered_records(std::move(all));
  const MatNames names(variables, file.left_out);
  const auto frequencies = frequencies_in(variables, names);
  std::vector<JsonNumber> singles;
  std::vector<KeyedUnit> single_units;
  const std::size_t lines = frequencies ? frequencies->values.size() : 0;
  for (const auto& variable : variables) {
    if (is_description(variable.name)) continue;
    if (const auto* real = std::get_if<MatMatrix>(&variable.value)) {
      const auto signals = names.of(variable.name, signal_suffixes(*real));
      for (std::size_t j = 0; j < signals.size(); ++j) {
        add_signal(signals[j], signal_of(*real, j), file);
      }
      if (!signals.empty()) continue;
    } else if (const auto* complex = std::get_if<MatComplexMatrix>(&variable.value)) {
      const auto signals = names.of(variable.name, signal_suffixes(*complex));
      for (std::size_t j = 0; j < signals.size(); ++j) {
        auto values = signal_of(*complex, j);
        if (values.size() != lines) {
          file.left_out.push_back(
              fmt::format("{}: complex, and no vector of frequencies is as long", signals[j].path));
          continue;
        }
        require_clear_unit(*frequencies, signals[j]);
        std::vector<double> frequency_Hz = frequencies->values;
        for (auto& value : frequency_Hz) value *= hertz_in_one(frequencies->unit);
        const ResponseUnit unit = split_response_unit(signals[j].unit);
        file.responses.push_back({signals[j].name, unit.unit, unit.per, std::move(frequency_Hz),
                                  std::move(values), std::vector<double>(lines, kUnknown)});
      }
      if (!signals.empty()) continue;
    }
    std::string phrase = fmt::format("{}: no vector of numbers", variable.name);
    if (const auto* one = std::get_if<MatMatrix>(&variable.value);
        one != nullptr && one->values.size() == 1) {
      const bool is_beside = std::ranges::any_of(variables, [&](const MatVariable& other) {
        return is_large(other) && owner_of(other.name) == owner_of(variable.name);
      });
      const std::string sentence = unapplied_factor(variable.name, one->values.front());
      if (is_beside && !sentence.empty()) file.table.assumptions.push_back(sentence);
      const std::string key = variable.name.substr(variable.name.rfind('.') + 1);
      singles.push_back({key, fmt::format("{}", one->values.front()), phrase});
      const auto* unit = names.keyed_units().find(variable.name);
      single_units.push_back({"", key, unit == nullptr ? "" : unit->text});
    }
    // What structures say of their signals is no signal.
    if (names.keyed_units().is_placed(variable.name)) continue;
    if (variable.name.find('.') != std::string::npos && !is_large(variable)) continue;
    file.left_out.push_back(std::move(phrase));
  }
  if (file.responses.empty()) add_json_times(file.table, singles, single_units, file.left_out);
  if (!file.responses.empty()) {
    file.table.assumptions.push_back(
        fmt::format(fmt::runtime(frequencies->is_unit_told ? "{} holds frequencies in {}"
                                                           : "unit of {} not given; {} assumed"),
                    arm::shown(frequencies->path), frequencies->unit));
  }
  use_paths_of_namesakes(file.table);
}

}  // namespace

ForeignFile mat_contents(const std::filesystem::path& path) {
  MatContents contents = read_mat_contents(path);
  if (contents.variables.empty() && !contents.left_out.empty()) {
    throw InputError(
        fmt::format("{}: MATLAB file without numbers; it has {}", arm::shown(path.string()),
                    arm::shown(fmt::format("{}", fmt::join(contents.left_out, "; ")), 400)));
  }
  ForeignFile file;
  file.format = contents.level == MatLevel::level4    ? ForeignFormat::matlab4
                : contents.level == MatLevel::level73 ? ForeignFormat::matlab73
                                                      : ForeignFormat::matlab5;
  file.left_out = std::move(contents.left_out);
  const auto* schema = find<std::string>(contents.variables, "schema");
  try {
    if (schema != nullptr && *schema == kTimeRecordSchema) {
      read_time_variables(contents.variables, file);
    } else if (schema != nullptr && *schema == kFrequencyRecordSchema) {
      read_frequency_variables(contents.variables, file);
    } else {
      read_other_variables(std::move(contents.variables), file);
    }
    const std::size_t signals = file.table.columns.size() + file.responses.size();
    if (signals > kMostRecordColumns) {
      throw InputError(fmt::format("{} signals; at most {} are read", signals, kMostRecordColumns));
    }
  } catch (const InputError& error) {
    throw arm::located(error, arm::shown(path.string()), 0);
  }
  return file;
}

}  // namespace flexarm::measured
