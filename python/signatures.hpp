#pragma once

#include <map>
#include <pybind11/pybind11.h>
#include <string>

namespace flexarm::python {

/// The keyword arguments that a function takes as a dict, "duration_s=None, seed=1", by the name of
/// the function, "simulate".
using Keywords = std::map<std::string, std::string>;

/// Gives every function and method of the extension the signature that it was bound with, so that
/// inspect.signature and help() show arguments and defaults.
void add_signatures(const pybind11::module_& module, const Keywords& keywords);

}  // namespace flexarm::python
