#include "arm/input_error.hpp"
#include "python/module.hpp"

#include <exception>

namespace flexarm::python {

namespace py = pybind11;

void add_errors(py::module_& module) {
  // Never destroyed: the translator may be called while the interpreter ends.
  static PyObject* type = PyErr_NewExceptionWithDoc(
      "flexarm.InputError",
      "Input that cannot be used: a file, a number, a name.\n\nIts text is the line that the "
      "program flexarm shows on the same input, with the file and its line, the key, the value and "
      "what is allowed. Where the program names an option, --max-causes, the text names the "
      "argument, max_causes.",
      PyExc_ValueError, nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.attr("InputError") = py::handle(type);
  py::register_exception_translator([](std::exception_ptr raised) {
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const arm::InputError& error) {
      PyErr_SetString(type, error.what());
    }
  });
}

}  // namespace flexarm::python
