#pragma once

#include "measured/files/time_record.hpp"
#include "python/arm.hpp"
#include "python/arrays.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace flexarm::python {

/// The place of a sensor among `sensors`. Throws arm::InputError where it is not there.
std::size_t place_of(const std::string& name, const std::vector<arm::Sensor>& sensors);
/// The place of a sensor among the channels of a record.
std::size_t channel_of(const measured::TimeRecord& record, const std::string& name);

std::vector<std::string> texts_of(const std::vector<arm::Sensor>& sensors);
std::vector<std::string> names_of_channels(const measured::TimeRecord& record);
pybind11::tuple units_of(const std::vector<arm::Sensor>& sensors);
std::vector<arm::Sensor> sensors_of_record(const measured::TimeRecord& record);

/// Gives a class that has a time record its arrays.
template <class Object, class Class>
void add_record_access(Class& type, measured::TimeRecord Object::*member) {
  namespace py = pybind11;
  const auto record = [member](const py::object& self) -> const measured::TimeRecord& {
    return self.cast<const Object&>().*member;
  };
  type.def_property_readonly(
          "time_s",
          [record](const py::object& self) { return view<double>(record(self).time_s, self); },
          "t [s], read-only array (samples,).")
      .def_property_readonly(
          "torque_N_m",
          [record](const py::object& self) { return view<double>(record(self).torque_N_m, self); },
          "Commanded torque [N m], read-only array (samples,).")
      .def_property_readonly(
          "reference",
          [record](const py::object& self) -> py::object {
            const auto& values = record(self).reference.values;
            if (values.empty()) return py::none();
            return view<double>(values, self);
          },
          "Reference of a closed loop, in the unit of its sensor, read-only array (samples,); None "
          "in open loop.")
      .def_property_readonly(
          "reference_unit",
          [record](const py::object& self) { return record(self).reference.unit; },
          "Unit of the reference, '' in open loop.")
      .def_property_readonly(
          "sensors",
          [record](const py::object& self) { return names_of(sensors_of_record(record(self))); },
          "Names of the sensors.")
      .def_property_readonly(
          "units",
          [record](const py::object& self) { return units_of(sensors_of_record(record(self))); },
          "Their units.")
      .def("__getitem__",
           [record](const py::object& self, const std::string& sensor) {
             const auto& of = record(self);
             return view<double>(of.channels[channel_of(of, sensor)].values, self);
           })
      .def("__len__", [record](const py::object& self) { return record(self).time_s.size(); });
}

}  // namespace flexarm::python
