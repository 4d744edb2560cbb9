#pragma once

#include <pybind11/pybind11.h>

namespace flexarm::python {

/// Gives every function and method of the extension the signature that it was bound with, so that
/// inspect.signature and help() show its arguments and defaults. Where a function takes a dict of
/// keywords, its docstring begins with them, "seed=1, noise=0.0", and a line "--".
void add_signatures(const pybind11::module_& module);

}  // namespace flexarm::python
