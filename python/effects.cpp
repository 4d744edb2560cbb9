#include "arm/effects.hpp"

#include "arm/ports.hpp"
#include "effects/registry/vocabulary.hpp"
#include "python/module.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace flexarm::python {

namespace py = pybind11;

namespace {

std::string sensor_name(const arm::Effect& effect) {
  return effect.definition->sensor ? arm::to_string(effect.acting_sensor()) : std::string();
}

std::map<std::string, std::string> units_of(const arm::Effect& effect) {
  std::map<std::string, std::string> units;
  for (const auto& parameter : effect.definition->parameters) {
    units[parameter.name] = effects::unit_of(parameter, sensor_name(effect));
  }
  return units;
}

std::string effect_text(const arm::Effect& effect) {
  std::vector<std::string> parts;
  const auto units = units_of(effect);
  for (const auto& [name, value] : effect.parameters) {
    const auto unit = units.find(name);
    const bool has_unit = unit != units.end() && unit->second != "1";
    parts.push_back(fmt::format("{} {:g}{}", name, value, has_unit ? " " + unit->second : ""));
  }
  if (effect.definition->sensor) parts.push_back("on " + sensor_name(effect));
  return fmt::format("<flexarm.Effect {}: {}>", effect.definition->name, fmt::join(parts, ", "));
}

std::vector<std::string> port_names(const effects::Entry& entry) {
  std::vector<std::string> names;
  for (const auto port : entry.definition->ports()) names.emplace_back(arm::to_string(port));
  return names;
}

}  // namespace

void add_effects(py::module_& module) {
  py::class_<arm::Effect>(module, "Effect", "An effect of an arm.")
      .def_property_readonly(
          "name", [](const arm::Effect& effect) { return effect.definition->name; }, "Its name.")
      .def_property_readonly(
          "parameters", [](const arm::Effect& effect) { return effect.parameters; },
          "The parameters that the arm gives, a dict of numbers in `units`.")
      .def_property_readonly("units", &units_of, "Units of the parameters, a dict.")
      .def_property_readonly("sensor", &sensor_name,
                             "The sensor that it acts on, '' where it acts on none.")
      .def_property_readonly(
          "meaning", [](const arm::Effect& effect) { return effect.definition->meaning; },
          "What it is.")
      .def("__eq__", [](const arm::Effect& a, const arm::Effect& b) { return a == b; })
      .def("__repr__", &effect_text)
      .attr("__hash__") = py::none();

  py::class_<arm::EffectParameter>(module, "EffectParameter", "A parameter of an effect.")
      .def_readonly("name", &arm::EffectParameter::name, "As in an arm file.")
      .def_readonly("unit", &arm::EffectParameter::unit, "Its unit; '1' for a plain number.")
      .def_readonly("meaning", &arm::EffectParameter::meaning, "What it is.")
      .def_readonly("example", &arm::EffectParameter::example,
                    "A value that shows on an arm like the paper's.")
      .def_readonly("default", &arm::EffectParameter::otherwise,
                    "Its value where it is not given; None: it must be.")
      .def_property_readonly(
          "allowed",
          [](const arm::EffectParameter& parameter) { return arm::to_string(parameter.range); },
          "The values allowed, in words.")
      .def("__repr__", [](const arm::EffectParameter& parameter) {
        return fmt::format("<flexarm.EffectParameter {} [{}]: {}>", parameter.name, parameter.unit,
                           parameter.meaning);
      });

  py::class_<effects::Entry>(
      module, "EffectDefinition",
      "An effect of the library: what an arm may have and a diagnosis names.")
      .def_property_readonly(
          "name", [](const effects::Entry& entry) { return entry.definition->name; },
          "Its name in an arm file.")
      .def_property_readonly(
          "meaning", [](const effects::Entry& entry) { return entry.definition->meaning; },
          "What it is.")
      .def_property_readonly(
          "parameters", [](const effects::Entry& entry) { return entry.definition->parameters; },
          "Its parameters, a list of EffectParameter.")
      .def_property_readonly("ports", &port_names, "The ports through which it acts, a list.")
      .def_readonly("evidence", &effects::Entry::speaks_for, "What the data show where it acts.")
      .def_readonly("evidence_against", &effects::Entry::refuted_by,
                    "What would show that it does not act.")
      .def("__repr__", [](const effects::Entry& entry) {
        return fmt::format("<flexarm.EffectDefinition {}: {}>", entry.definition->name,
                           entry.definition->meaning);
      });

  module.def("effects", &effects::entries,
             "All effects of the library, a list of EffectDefinition.");
}

}  // namespace flexarm::python
