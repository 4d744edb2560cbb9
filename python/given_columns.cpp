#include "python/given_columns.hpp"

#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "measured/files/column_mapping.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/universal_grid.hpp"
#include "python/arm.hpp"
#include "python/arrays.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using arm::InputError;

constexpr std::string_view kCoherence = "_coherence";

template <class T>
using PlainArray = py::array_t<T, py::array::c_style | py::array::forcecast>;

std::string type_of(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

/// A column's values as doubles or complex numbers. NumPy would take numbers of texts and of dates,
/// and drop imaginary parts.
template <class T>
std::vector<T> values_of(const GivenColumn& column) {
  constexpr bool kIsReal = std::is_same_v<T, double>;
  constexpr const char* kWanted = kIsReal ? "real numbers" : "numbers";
  const py::array given = py::array::ensure(column.values);
  if (!given) PyErr_Clear();
  const bool has_numbers =
      given && std::string_view(kIsReal ? "fiubO" : "fiubOc").find(given.dtype().kind()) !=
                   std::string_view::npos;
  const auto array = has_numbers ? PlainArray<T>::ensure(given) : PlainArray<T>();
  if (!has_numbers || !array) {
    PyErr_Clear();
    throw InputError(fmt::format(
        "{}: {}; must be an array of {}", column.name,
        given ? "values of type " + std::string(py::str(given.dtype())) : type_of(column.values),
        kWanted));
  }
  if (array.ndim() != 1) {
    throw InputError(fmt::format("{}: an array of {} dimensions; must be of 1", column.name,
                                 static_cast<long>(array.ndim())));
  }
  std::vector<T> values(array.data(), array.data() + array.size());
  const auto bad = std::ranges::find_if(
      values, [](const auto& value) { return !std::isfinite(std::abs(value)); });
  if (bad != values.end()) {
    throw InputError(
        fmt::format("{} = {} at index {}: must be finite; flexarm.import_log takes logs "
                    "with missing samples (fill_gaps)",
                    column.name, std::string(py::str(py::cast(*bad))), bad - values.begin()));
  }
  return values;
}

/// What a column is, and in which unit.
struct Named {
  std::string quantity;
  std::string unit;
};

/// "hub_angle_rad", "hub_angle_deg" of the SI unit and the others that are commonly used.
std::string names_in_units(const std::string& quantity, std::string_view behind) {
  std::vector<std::string> names;
  for (const auto& unit : measured::unit_names(quantity)) {
    if (unit == "1" || unit == "%" || unit == "min") continue;
    names.push_back(fmt::format("{}_{}{}", quantity, unit_in_name(unit), behind));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// `behind` is what stands behind the unit, for the names in errors.
Named named(const GivenColumn& column, const std::string& name, std::string_view behind = "") {
  const auto [base, unit] = measured::split_column_name(name);
  try {
    std::string quantity = measured::standard_name(base);
    const bool is_plain = measured::si_unit_of(quantity) == "1";
    if ((unit.empty() && !is_plain) || !measured::is_unit_of(quantity, unit)) {
      throw InputError(fmt::format("{}; must be {}",
                                   unit.empty() ? "no unit in the name" : unit + " is not its unit",
                                   names_in_units(quantity, behind)));
    }
    return {std::move(quantity), unit};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", column.name, error.what()));
  }
}

void convert(std::vector<double>& values, const Named& name) {
  if (const auto unit = measured::unit_of(name.quantity, name.unit)) {
    for (auto& value : values) value = unit->to_si(value);
  } else {
    const double scale = measured::scale_of_unit(name.quantity, name.unit);
    for (auto& value : values) value *= scale;
  }
}

/// The reference of a loop, in the unit of its name.
measured::Reference reference_of(const GivenColumn& column) {
  const std::string unit = measured::split_column_name(column.name).unit;
  for (const auto kind :
       {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement", "strain@0"}) {
    if (!measured::is_unit_of(kind, unit)) continue;
    measured::Reference reference{std::string(measured::si_unit_of(kind)),
                                  values_of<double>(column)};
    convert(reference.values, {kind, unit});
    return reference;
  }
  throw InputError(
      fmt::format("{}: {}; must be that of the controller's sensor, as in "
                  "reference_rad or reference_deg",
                  column.name, unit.empty() ? "no unit in the name" : "unit " + unit));
}

bool is_reference(const std::string& name) {
  return measured::split_column_name(name).base == measured::kReferenceColumn;
}

/// The channel of a sensor's response, which may be new.
measured::FrequencyChannel& channel_of(measured::FrequencyRecord& record,
                                       const arm::Sensor& sensor) {
  const auto found =
      std::ranges::find(record.channels, sensor, &measured::FrequencyChannel::sensor);
  if (found != record.channels.end()) return *found;
  return record.channels.emplace_back(measured::FrequencyChannel{sensor, {}, {}, {}});
}

}  // namespace

std::vector<GivenColumn> columns_of(const py::object& data, const py::dict& keywords) {
  std::vector<GivenColumn> columns;
  const auto add = [&](const py::handle& key, const py::handle& values) {
    if (!py::isinstance<py::str>(key)) {
      throw InputError(fmt::format("data: column {}: its name must be text, as in hub_angle_rad",
                                   std::string(py::str(key))));
    }
    const auto name = key.cast<std::string>();
    if (std::ranges::count(columns, name, &GivenColumn::name) > 0) {
      throw InputError(name + ": given twice");
    }
    columns.push_back({name, py::reinterpret_borrow<py::object>(values)});
  };
  if (!data.is_none()) {
    if (!py::hasattr(data, "items")) {
      throw InputError(fmt::format("data: {}; must be a dict or a DataFrame with columns as time_s",
                                   type_of(data)));
    }
    if (py::hasattr(data, "index") && !data.attr("index").attr("name").is_none()) {
      add(data.attr("index").attr("name"), data.attr("index").attr("to_numpy")());
    }
    for (const auto& item : data.attr("items")()) {
      const auto pair = item.cast<py::tuple>();
      add(pair[0], pair[1]);
    }
  }
  for (const auto& [key, values] : keywords) {
    if (!values.is_none()) add(key, values);
  }
  return columns;
}

measured::TimeRecord time_record_of(const std::vector<GivenColumn>& columns,
                                    const py::object& sample_time_s) {
  measured::TimeRecord record;
  for (const auto& column : columns) {
    if (is_reference(column.name)) {
      record.reference = reference_of(column);
      continue;
    }
    const Named name = named(column, column.name);
    auto values = values_of<double>(column);
    convert(values, name);
    if (const auto sensor = measured::sensor_of(name.quantity)) {
      record.channels.push_back({*sensor, std::move(values)});
      continue;
    }
    auto& of_record = name.quantity == "time" ? record.time_s : record.torque_N_m;
    if (!of_record.empty())
      throw InputError(fmt::format("{}: {} given twice", column.name, name.quantity));
    of_record = std::move(values);
  }
  if (record.channels.empty()) {
    throw InputError("no sensor; needs one or more, as in hub_angle_rad");
  }
  const std::size_t samples = record.channels.front().values.size();
  if (record.torque_N_m.empty()) {
    throw InputError("torque_N_m: missing; of a free decay it is an array of zeros");
  }
  if (!sample_time_s.is_none()) {
    if (!record.time_s.empty()) throw InputError("sample_time_s: not together with time");
    const auto period_s = sample_time_s.cast<double>();
    arm::require_in_range("sample_time_s", period_s, "s", arm::kPositive);
    record.time_s = measured::grid_points({0.0, period_s}, samples);
  }
  if (record.time_s.empty()) throw InputError("time_s: missing; needs it, or sample_time_s");
  return record;
}

measured::FrequencyRecord frequency_record_of(const std::vector<GivenColumn>& columns,
                                              const std::string& input) {
  measured::FrequencyRecord record;
  record.input = measured::parse_response_input(input);
  const std::string per =
      fmt::format("_per_{}", record.input ? unit_in_name(arm::unit(*record.input)) : "N_m");
  std::vector<double> frequency_Hz;
  for (const auto& column : columns) {
    if (column.name == "frequency_Hz") {
      frequency_Hz = values_of<double>(column);
    } else if (column.name.ends_with(kCoherence)) {
      const std::string sensor = column.name.substr(0, column.name.size() - kCoherence.size());
      channel_of(record, arm::parse_sensor(sensor)).coherence = values_of<double>(column);
    } else if (column.name.ends_with(per)) {
      const std::string name_of_unit = column.name.substr(0, column.name.size() - per.size());
      const Named name = named(column, name_of_unit, per);
      const auto sensor = measured::sensor_of(name.quantity);
      if (!sensor) {
        throw InputError(
            fmt::format("{}: must be a sensor's, as in tip_displacement_m{}", column.name, per));
      }
      auto& channel = channel_of(record, *sensor);
      channel.response = values_of<std::complex<double>>(column);
      const double scale = measured::conversion_of(name.quantity, name.unit).value_or(1.0);
      for (auto& value : channel.response) value *= scale;
    } else {
      throw InputError(
          fmt::format("{}: must be frequency_Hz, a response as tip_displacement_m{}, or "
                      "tip_displacement_coherence",
                      column.name, per));
    }
  }
  if (frequency_Hz.empty()) throw InputError("frequency_Hz: missing");
  for (auto& channel : record.channels) {
    channel.frequency_Hz = frequency_Hz;
    if (!channel.coherence.empty()) continue;
    channel.coherence.assign(frequency_Hz.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return record;
}

std::string column_keywords(const std::string& per) {
  std::vector<std::string> names;
  if (per.empty()) names = {"time_s", "torque_N_m"};
  for (const auto kind :
       {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement", "tip_deflection"}) {
    names.push_back(fmt::format("{}_{}{}", kind, unit_in_name(measured::si_unit_of(kind)), per));
  }
  return fmt::format("{}=None, **columns", fmt::join(names, "=None, "));
}

}  // namespace flexarm::python
