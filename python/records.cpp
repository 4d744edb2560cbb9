#include "python/records.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace flexarm::python {

namespace py = pybind11;

std::size_t place_of(const std::string& name, const std::vector<arm::Sensor>& sensors) {
  const auto found = std::ranges::find(sensors, arm::parse_sensor(name));
  if (found != sensors.end()) return static_cast<std::size_t>(found - sensors.begin());
  throw arm::InputError(fmt::format("{}: not among the sensors, which are {}", arm::shown(name),
                                    fmt::join(texts_of(sensors), ", ")));
}

std::size_t channel_of(const measured::TimeRecord& record, const std::string& name) {
  return place_of(name, sensors_of_record(record));
}

std::vector<std::string> texts_of(const std::vector<arm::Sensor>& sensors) {
  std::vector<std::string> texts;
  for (const auto& sensor : sensors) texts.push_back(arm::to_string(sensor));
  return texts;
}

std::vector<std::string> names_of_channels(const measured::TimeRecord& record) {
  return texts_of(sensors_of_record(record));
}

py::tuple units_of(const std::vector<arm::Sensor>& sensors) {
  py::tuple units(sensors.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) units[i] = std::string(arm::unit(sensors[i]));
  return units;
}

std::vector<arm::Sensor> sensors_of_record(const measured::TimeRecord& record) {
  std::vector<arm::Sensor> sensors;
  for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
  return sensors;
}

}  // namespace flexarm::python
