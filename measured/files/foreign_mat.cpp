#include "measured/files/foreign_mat.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/mat_file.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/record_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
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

/// Vectors, and matrices by columns, as `add(name, values)`.
template <class T, class Add>
bool add_columns(const std::string& name, const MatArray<T>& matrix, const Add& add) {
  const std::size_t shorter = std::min(matrix.rows, matrix.columns);
  const std::size_t longer = std::max(matrix.rows, matrix.columns);
  if (shorter == 0 || longer < 2) return false;
  if (shorter == 1) {
    add(name, matrix.values);
    return true;
  }
  if (matrix.columns > kMostColumns || matrix.rows < matrix.columns) return false;
  for (std::size_t j = 0; j < matrix.columns; ++j) {
    const auto begin = matrix.values.begin() + static_cast<std::ptrdiff_t>(j * matrix.rows);
    add(fmt::format("{}(:,{})", name, j + 1),
        std::vector<T>(begin, begin + static_cast<std::ptrdiff_t>(matrix.rows)));
  }
  return true;
}

/// What stands behind the last point of a structure's field, in lower case.
std::string field_name(std::string_view name) {
  std::string field(name.substr(name.rfind('.') + 1));
  std::ranges::transform(field, field.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return field;
}

/// Hz in one of the vector's unit; 0 for a vector that holds no frequencies.
double hertz_of(std::string_view name) {
  constexpr std::array<std::string_view, 5> kHertz = {"f", "freq", "freqs", "frequency", "hz"};
  constexpr std::array<std::string_view, 4> kRadians = {"w", "omega", "freq_rad", "w_rad"};
  const std::string field = field_name(name);
  const ColumnName split = split_column_name(field);
  const auto is_one_of = [](const auto& names, std::string_view word) {
    return std::ranges::count(names, word) > 0;
  };
  if (is_one_of(kRadians, field) || (split.unit == "rad/s" && is_one_of(kHertz, split.base))) {
    return 1.0 / (2.0 * std::numbers::pi);
  }
  const bool in_hertz = split.unit.empty() || split.unit == "Hz";
  return in_hertz && is_one_of(kHertz, split.base) ? 1.0 : 0.0;
}

void read_other_variables(const std::vector<MatVariable>& variables, ForeignFile& file) {
  std::vector<double> frequency_Hz;
  for (const auto& variable : variables) {
    const auto* matrix = std::get_if<MatMatrix>(&variable.value);
    const double factor = matrix == nullptr ? 0.0 : hertz_of(variable.name);
    if (factor == 0.0 || std::min(matrix->rows, matrix->columns) != 1) continue;
    frequency_Hz = matrix->values;
    for (auto& value : frequency_Hz) value *= factor;
    file.table.assumptions.push_back(fmt::format(
        "{} holds frequencies in {}", arm::shown(variable.name), factor == 1.0 ? "Hz" : "rad/s"));
    break;
  }
  for (const auto& variable : variables) {
    bool is_used = false;
    if (const auto* real = std::get_if<MatMatrix>(&variable.value)) {
      is_used = add_columns(variable.name, *real, [&](const std::string& name, const auto& values) {
        file.table.columns.push_back({name, split_column_name(field_name(name)).unit, values});
      });
    } else if (const auto* complex = std::get_if<MatComplexMatrix>(&variable.value)) {
      is_used =
          add_columns(variable.name, *complex, [&](const std::string& name, const auto& values) {
            if (values.size() != frequency_Hz.size()) {
              file.left_out.push_back(
                  fmt::format("{}: complex, and no vector of frequencies is as "
                              "long",
                              name));
              return;
            }
            file.responses.push_back(
                {name, "", "", frequency_Hz, values, std::vector<double>(values.size(), kUnknown)});
          });
    }
    if (!is_used) file.left_out.push_back(fmt::format("{}: no vector of numbers", variable.name));
  }
}

}  // namespace

ForeignFile mat_contents(const std::filesystem::path& path) {
  MatContents contents = read_mat_contents(path);
  ForeignFile file;
  file.format = ForeignFormat::matlab;
  file.left_out = std::move(contents.left_out);
  const auto* schema = find<std::string>(contents.variables, "schema");
  try {
    if (schema != nullptr && *schema == kTimeRecordSchema) {
      read_time_variables(contents.variables, file);
    } else if (schema != nullptr && *schema == kFrequencyRecordSchema) {
      read_frequency_variables(contents.variables, file);
    } else {
      read_other_variables(contents.variables, file);
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
