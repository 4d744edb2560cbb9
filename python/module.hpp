#pragma once

#include <pybind11/pybind11.h>

namespace flexarm::python {

/// Each adds the classes and functions of one subject to the extension, in the order in which they
/// need each other. Docstrings state units, shapes and errors; names of numbers end in their unit.
void add_errors(pybind11::module_& module);
void add_arm(pybind11::module_& module);
void add_effects(pybind11::module_& module);
void add_roots(pybind11::module_& module);
void add_responses(pybind11::module_& module);
void add_formulations(pybind11::module_& module);
void add_controllers(pybind11::module_& module);
void add_simulated_runs(pybind11::module_& module);
void add_simulation(pybind11::module_& module);
void add_measurements(pybind11::module_& module);
void add_importing(pybind11::module_& module);
void add_identification(pybind11::module_& module);
void add_planning(pybind11::module_& module);
void add_diagnosis(pybind11::module_& module);

}  // namespace flexarm::python
