#include "measured/files/record_export.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace flexarm::measured {

namespace {

/// Data types of axes.
enum AxisQuantity : int {
  kGeneral = 1,
  kMoment = 9,
  kTimeQuantity = 17,
  kFrequencyQuantity = 18,
};

std::string header_of(const arm::Sensor& sensor) {
  return fmt::format("{} [{}]", arm::to_string(sensor), arm::unit(sensor));
}

UniversalAxis time_axis() {
  return {kTimeQuantity, 0, 0, 0, "time", "s"};
}

UniversalAxis torque_axis() {
  return {kMoment, 1, 1, 0, "torque", "N m"};
}

UniversalAxis sensor_axis(const arm::Sensor& sensor) {
  return {kGeneral, 0, 0, 0, arm::to_string(sensor), std::string(arm::unit(sensor))};
}

UniversalFunction coherence_of(const FrequencyChannel& channel) {
  UniversalFunction coherence;
  coherence.id[0] = header_of(channel.sensor);
  coherence.type = kUniversalCoherence;
  coherence.abscissa_axis = {kFrequencyQuantity, 0, 0, 0, "frequency", "Hz"};
  coherence.ordinate_axis = {kGeneral, 0, 0, 0, "coherence", "1"};
  for (std::size_t i = 0; i < channel.frequency_Hz.size(); ++i) {
    if (std::isnan(channel.coherence[i])) continue;
    coherence.abscissa.push_back(channel.frequency_Hz[i]);
    coherence.real.push_back(channel.coherence[i]);
  }
  return coherence;
}

MatMatrix column_of(const std::vector<double>& values) {
  return {values.size(), 1, values};
}

template <class Channels>
void add_sensors(std::vector<MatVariable>& variables, const Channels& channels) {
  MatStrings sensors;
  MatStrings units;
  for (const auto& channel : channels) {
    sensors.push_back(arm::to_string(channel.sensor));
    units.emplace_back(arm::unit(channel.sensor));
  }
  variables.push_back({"sensors", std::move(sensors)});
  variables.push_back({"units", std::move(units)});
}

}  // namespace

std::vector<UniversalFunction> universal_functions(const TimeRecord& record) {
  std::vector<UniversalFunction> functions;
  const auto add = [&](std::string id, UniversalAxis axis, const std::vector<double>& values) {
    UniversalFunction function;
    function.id[0] = std::move(id);
    function.number = static_cast<int>(functions.size()) + 1;
    function.abscissa_axis = time_axis();
    function.ordinate_axis = std::move(axis);
    function.abscissa = record.time_s;
    function.real = values;
    functions.push_back(std::move(function));
  };
  add("torque [N m]", torque_axis(), record.torque_N_m);
  for (const auto& channel : record.channels) {
    add(header_of(channel.sensor), sensor_axis(channel.sensor), channel.values);
  }
  const Reference& reference = record.reference;
  if (!reference.values.empty()) {
    const std::string name(kReferenceColumn);
    add(fmt::format("{} [{}]", name, reference.unit), {kGeneral, 0, 0, 0, name, reference.unit},
        reference.values);
  }
  return functions;
}

std::vector<UniversalFunction> universal_functions(const FrequencyRecord& record) {
  std::vector<UniversalFunction> functions;
  for (const auto& channel : record.channels) {
    UniversalFunction function;
    function.id[0] = header_of(channel.sensor);
    function.type = kUniversalFrequencyResponse;
    function.abscissa_axis = {kFrequencyQuantity, 0, 0, 0, "frequency", "Hz"};
    function.ordinate_axis = sensor_axis(channel.sensor);
    function.denominator_axis = torque_axis();
    function.abscissa = channel.frequency_Hz;
    for (const auto& value : channel.response) {
      function.real.push_back(value.real());
      function.imaginary.push_back(value.imag());
    }
    functions.push_back(std::move(function));
    UniversalFunction coherence = coherence_of(channel);
    if (!coherence.abscissa.empty()) functions.push_back(std::move(coherence));
  }
  for (std::size_t i = 0; i < functions.size(); ++i) {
    functions[i].number = static_cast<int>(i) + 1;
  }
  return functions;
}

std::vector<MatVariable> mat_variables(const TimeRecord& record) {
  std::vector<MatVariable> variables = {{"schema", std::string(kTimeRecordSchema)},
                                        {"time_s", column_of(record.time_s)},
                                        {"torque_N_m", column_of(record.torque_N_m)}};
  add_sensors(variables, record.channels);
  MatMatrix values{record.time_s.size(), record.channels.size(), {}};
  for (const auto& channel : record.channels) {
    values.values.insert(values.values.end(), channel.values.begin(), channel.values.end());
  }
  variables.push_back({"values", std::move(values)});
  if (!record.reference.values.empty()) {
    variables.push_back({"reference", column_of(record.reference.values)});
    variables.push_back({"reference_unit", record.reference.unit});
  }
  return variables;
}

std::vector<MatVariable> mat_variables(const FrequencyRecord& record) {
  std::vector<MatVariable> variables = {{"schema", std::string(kFrequencyRecordSchema)}};
  add_sensors(variables, record.channels);
  int k = 0;
  for (const auto& channel : record.channels) {
    ++k;
    variables.push_back({fmt::format("frequency_Hz_{}", k), column_of(channel.frequency_Hz)});
    variables.push_back({fmt::format("response_{}", k),
                         MatComplexMatrix{channel.response.size(), 1, channel.response}});
    variables.push_back({fmt::format("coherence_{}", k), column_of(channel.coherence)});
  }
  return variables;
}

}  // namespace flexarm::measured
