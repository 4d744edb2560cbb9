#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "python/arrays.hpp"
#include "python/module.hpp"
#include "python/records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::python {

namespace py = pybind11;

namespace {

struct TimeRun {
  measured::Run run;
  measured::TimeRecord record;
};

struct FrequencyRun {
  measured::Run run;
  measured::FrequencyRecord record;
};

struct ModalRun {
  measured::Run run;
  measured::ModalTable table;
};

using AnyRun = std::variant<TimeRun, FrequencyRun, ModalRun>;

struct Measurement {
  std::string name;
  std::filesystem::path arm_file;
  std::vector<AnyRun> runs;
};

Measurement read_measurement(const std::filesystem::path& path) {
  const auto file = measured::read_measurement(path);
  Measurement measurement{
      file.name, file.arm.empty() ? std::filesystem::path() : measured::beside(path, file.arm), {}};
  for (const auto& run : file.runs) {
    auto data = measured::read_run(path, run);
    if (auto* record = std::get_if<measured::TimeRecord>(&data)) {
      measurement.runs.emplace_back(TimeRun{run, std::move(*record)});
    } else if (auto* responses = std::get_if<measured::FrequencyRecord>(&data)) {
      measurement.runs.emplace_back(FrequencyRun{run, std::move(*responses)});
    } else {
      measurement.runs.emplace_back(ModalRun{run, std::get<measured::ModalTable>(std::move(data))});
    }
  }
  return measurement;
}

std::vector<arm::Sensor> sensors_in(const measured::FrequencyRecord& record) {
  std::vector<arm::Sensor> sensors;
  for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
  return sensors;
}

/// The getter or method of one sensor's numbers, which are `member` of its channel.
template <class T>
auto of_channel(std::vector<T> measured::FrequencyChannel::*member) {
  return [member](const py::object& self, const std::string& sensor) {
    const auto& record = self.cast<const FrequencyRun&>().record;
    return view<T>(record.channels[place_of(sensor, sensors_in(record))].*member, self);
  };
}

template <class Class>
Class& add_run_facts(Class& type) {
  using Run = typename Class::type;
  type.def_property_readonly(
          "id", [](const Run& self) { return self.run.id; }, "Its id.")
      .def_property_readonly(
          "purpose",
          [](const Run& self) -> std::optional<std::string> {
            if (!self.run.purpose) return std::nullopt;
            return std::string(to_string(*self.run.purpose));
          },
          "'estimation' or 'validation'; None: the program chooses.")
      .def_property_readonly(
          "payload_mass_kg",
          [](const Run& self) -> std::optional<double> {
            if (!self.run.payload) return std::nullopt;
            return self.run.payload->mass_kg;
          },
          "Mass of its payload [kg]; None: that of the arm file.");
  return type;
}

void add_runs(py::module_& module) {
  auto time = py::class_<TimeRun>(
      module, "TimeRun",
      "A recording in time. run['hub_angle'] is what a sensor read, read-only array (samples,) in "
      "its SI unit.");
  add_record_access(add_run_facts(time), &TimeRun::record);
  time.def("__repr__", [](const TimeRun& self) {
    return fmt::format("<flexarm.TimeRun '{}': {} samples of {:g} s, {}>", self.run.id,
                       self.record.time_s.size(), measured::sampling_period_s(self.record),
                       fmt::join(names_of_channels(self.record), ", "));
  });

  auto frequency = py::class_<FrequencyRun>(
      module, "FrequencyRun",
      "Measured frequency responses. run['hub_angle'] is the response of a sensor, read-only "
      "complex array (frequencies,) in its unit per N m.");
  add_run_facts(frequency)
      .def_property_readonly(
          "sensors", [](const FrequencyRun& self) { return names_of(sensors_in(self.record)); },
          "Names of the sensors.")
      .def("__getitem__", of_channel(&measured::FrequencyChannel::response))
      .def("frequency_Hz", of_channel(&measured::FrequencyChannel::frequency_Hz), py::arg("sensor"),
           "f of a sensor's response [Hz], read-only array (frequencies,).")
      .def("coherence", of_channel(&measured::FrequencyChannel::coherence), py::arg("sensor"),
           "Coherence [1], NaN where unknown, read-only array (frequencies,).")
      .def("__repr__", [](const FrequencyRun& self) {
        return fmt::format("<flexarm.FrequencyRun '{}': {}>", self.run.id,
                           fmt::join(texts_of(sensors_in(self.record)), ", "));
      });

  using measured::ModalEntry;
  py::class_<ModalEntry>(module, "ModalEntry", "A measured pole or zero; None: not known.")
      .def_property_readonly(
          "feature", [](const ModalEntry& self) { return std::string(to_string(self.feature)); },
          "'pole' or 'zero'.")
      .def_property_readonly(
          "sensor",
          [](const ModalEntry& self) {
            return self.sensor ? std::optional(arm::to_string(*self.sensor)) : std::nullopt;
          },
          "Name of the sensor.")
      .def_readonly("order", &ModalEntry::order, "From 1.")
      .def_readonly("frequency_Hz", &ModalEntry::frequency_Hz, "Natural frequency [Hz].")
      .def_readonly("frequency_std_Hz", &ModalEntry::frequency_std_Hz,
                    "Its standard deviation [Hz].")
      .def_readonly("damping_ratio", &ModalEntry::damping_ratio, "Damping ratio [1].")
      .def_readonly("damping_ratio_std", &ModalEntry::damping_ratio_std,
                    "Its standard deviation [1].");
  auto modal = py::class_<ModalRun>(module, "ModalRun", "A table of measured poles and zeros.");
  add_run_facts(modal)
      .def_readonly("entries", &ModalRun::table, "A list of ModalEntry.")
      .def("__repr__", [](const ModalRun& self) {
        return fmt::format("<flexarm.ModalRun '{}': {} entries>", self.run.id, self.table.size());
      });
}

}  // namespace

void add_measurements(py::module_& module) {
  add_runs(module);
  py::class_<Measurement>(module, "Measurement", "Recordings of an experiment on one arm.")
      .def_readonly("name", &Measurement::name, "Its name.")
      .def_property_readonly(
          "arm_file", [](const Measurement& self) { return self.arm_file.string(); },
          "Path of the arm file.")
      .def_readonly("runs", &Measurement::runs,
                    "The runs, a list of TimeRun, FrequencyRun and ModalRun.")
      .def("__repr__", [](const Measurement& self) {
        return fmt::format("<flexarm.Measurement '{}': {} runs>", self.name, self.runs.size());
      });
  module.def("read_measurement", &read_measurement, py::arg("path"),
             "Reads measurement.toml and the files of its runs, in SI units (docs/formats.md): "
             "Measurement. Raises InputError 'FILE:LINE: ...'.");
}

}  // namespace flexarm::python
