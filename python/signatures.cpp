#include "python/signatures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::python {

namespace py = pybind11;

namespace {

/// What CPython looks for behind a signature in a docstring.
constexpr std::string_view kEnd = "\n--\n\n";

PyCFunctionObject* function_in(py::handle object) {
  const py::handle function = py::detail::get_function(object);
  return function && PyCFunction_Check(function.ptr()) != 0
             ? reinterpret_cast<PyCFunctionObject*>(function.ptr())  // NOLINT: as pybind11 does
             : nullptr;
}

/// What pybind11 knows of a function of its own; null of any other.
const py::detail::function_record* record_of(const PyCFunctionObject& function) {
  PyObject* capsule = function.m_self;
  if (capsule == nullptr || PyCapsule_CheckExact(capsule) == 0) return nullptr;
  return static_cast<const py::detail::function_record*>(
      PyCapsule_GetPointer(capsule, PyCapsule_GetName(capsule)));
}

/// "self, sensor, *, count=5".
std::string arguments_of(const py::detail::function_record& record, const std::string& keywords) {
  std::vector<std::string> parts;
  if (record.is_method && record.args.empty()) parts.emplace_back("self");
  for (std::size_t i = 0; i < record.args.size(); ++i) {
    const auto& argument = record.args[i];
    if (i == record.nargs_pos) parts.emplace_back("*");
    parts.push_back(argument.value
                        ? fmt::format("{}={}", argument.name, std::string(py::repr(argument.value)))
                        : argument.name);
  }
  if (!keywords.empty()) {
    const bool has_star = record.args.size() > record.nargs_pos || keywords.starts_with("**");
    if (!has_star) parts.emplace_back("*");
    parts.push_back(keywords);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Whether all arguments have names; those of operators have none.
bool is_named(const py::detail::function_record& record) {
  const int of_dicts = static_cast<int>(record.has_args) + static_cast<int>(record.has_kwargs);
  const auto arguments = static_cast<std::size_t>(record.nargs - of_dicts);
  return record.args.size() == arguments || (record.is_method && arguments == 1);
}

void put_signature(py::handle object) {
  PyCFunctionObject* function = function_in(object);
  const auto* record = function == nullptr ? nullptr : record_of(*function);
  if (record == nullptr || !is_named(*record)) return;
  PyMethodDef& method = *function->m_ml;
  std::string text = method.ml_doc == nullptr ? "" : method.ml_doc;
  std::string keywords;
  if (const auto end = text.find(kEnd); end != std::string::npos) {
    keywords = text.substr(0, end);
    text.erase(0, end + kEnd.size());
  }
  text = fmt::format("{}({}){}{}", record->name, arguments_of(*record, keywords), kEnd, text);
  std::free(const_cast<char*>(method.ml_doc));  // NOLINT: pybind11 allocates and frees it so
  method.ml_doc = ::strdup(text.c_str());
}

}  // namespace

void add_signatures(const py::module_& module) {
  for (const auto& [name, object] : py::dict(module.attr("__dict__"))) {
    if (!py::isinstance<py::type>(object)) {
      put_signature(object);
      continue;
    }
    for (const auto& [member_name, member] : py::dict(object.attr("__dict__"))) {
      put_signature(object.attr(member_name));
    }
  }
}

}  // namespace flexarm::python
