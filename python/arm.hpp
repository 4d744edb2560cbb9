#pragma once

#include "arm/arm.hpp"

#include <pybind11/pybind11.h>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::python {

/// A unit as part of a name: "N m s/rad" is "N_m_s_per_rad", "kg m^2" is "kg_m2".
std::string unit_in_name(std::string_view unit);

/// An arm that is given, or that of the path of an arm file. Throws arm::InputError as its reader,
/// and py::type_error, one line, for any other object.
arm::Arm arm_of(const pybind11::object& arm);

/// The sensors of a sequence of names, or of one name. Throws arm::InputError as parse_sensor.
std::vector<arm::Sensor> sensors_of(const pybind11::object& names);

/// Their names, as a tuple.
pybind11::tuple names_of(const std::vector<arm::Sensor>& sensors);

/// The sensors asked for, None: the hub angle and, with a beam, the tip acceleration.
std::vector<arm::Sensor> sensors_or_default(const pybind11::object& names, const arm::Arm& arm);

}  // namespace flexarm::python
