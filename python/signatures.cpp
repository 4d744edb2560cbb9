#include "python/signatures.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string>

namespace flexarm::python {

namespace py = pybind11;

namespace {

/// What pybind11 knows of a function; null for any other object.
py::detail::function_record* record_of(py::handle object) {
  const py::handle function = py::detail::get_function(object);
  if (!function || PyCFunction_Check(function.ptr()) == 0) return nullptr;
  PyObject* capsule = PyCFunction_GET_SELF(function.ptr());
  if (capsule == nullptr || PyCapsule_CheckExact(capsule) == 0) return nullptr;
  return static_cast<py::detail::function_record*>(
      PyCapsule_GetPointer(capsule, PyCapsule_GetName(capsule)));
}

/// "(self, sensor, count=5)"; empty where an argument has no name.
std::string signature_of(const py::detail::function_record& record, const std::string& keywords) {
  const std::size_t named = record.nargs - (record.has_args ? 1U : 0U) - (record.has_kwargs ? 1U : 0U);
  if (record.args.empty() && named == 1 && record.is_method) return "(self)";
  if (record.args.size() != named) return "";
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  bool is_keyword = false;
  for (std::size_t i = 0; i < named; ++i) {
    if (i == record.nargs_pos && !is_keyword) {
      add("*");
      is_keyword = true;
    }
    const auto& argument = record.args[i];
    add(argument.value ? fmt::format("{}={}", argument.name,
                                     py::repr(argument.value).cast<std::string>())
                       : argument.name);
  }
  if (record.has_kwargs) {
    if (!is_keyword && !keywords.starts_with("**")) add("*");
    add(keywords);
  }
  return "(" + text + ")";
}

/// CPython takes what stands in front of "--" for the signature: help() and inspect show it.
void put_signature(const std::string& name, py::handle object, const Keywords& keywords) {
  const auto* record = record_of(object);
  if (record == nullptr) return;
  const auto of_table = keywords.find(name);
  const std::string signature =
      signature_of(*record, of_table == keywords.end() ? "" : of_table->second);
  if (signature.empty()) return;
  PyMethodDef* method = reinterpret_cast<PyCFunctionObject*>(  // NOLINT: as pybind11 does
                            py::detail::get_function(object).ptr())
                            ->m_ml;
  const std::string text = fmt::format("{}{}\n--\n\n{}", record->name, signature,
                                       method->ml_doc == nullptr ? "" : method->ml_doc);
  std::free(const_cast<char*>(method->ml_doc));  // NOLINT: pybind11 allocates and frees it so
  method->ml_doc = ::strdup(text.c_str());
}

}  // namespace

void add_signatures(const py::module_& module, const Keywords& keywords) {
  for (const auto& [key, object] : module.attr("__dict__").cast<py::dict>()) {
    const auto name = key.cast<std::string>();
    if (!py::isinstance<py::type>(object)) {
      put_signature(name, object, keywords);
      continue;
    }
    for (const auto& member : py::dict(object.attr("__dict__"))) {
      const auto member_name = member.first.cast<std::string>();
      put_signature(name + "." + member_name, object.attr(member_name.c_str()), keywords);
    }
  }
}

}  // namespace flexarm::python
