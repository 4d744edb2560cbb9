#include "python/arm.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/nearest_name.hpp"
#include "arm/plausibility.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/usable_arm.hpp"
#include "python/module.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <pybind11/operators.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace flexarm::python {

namespace py = pybind11;

std::string unit_in_name(std::string_view unit) {
  std::string name;
  for (const char c : unit) {
    if (c == '/') {
      name += "_per_";
    } else if (c == ' ') {
      name += '_';
    } else if (c != '^') {
      name += c;
    }
  }
  return name;
}

arm::Arm arm_of(const py::object& arm) {
  if (py::isinstance<arm::Arm>(arm)) return arm.cast<arm::Arm>();
  if (py::isinstance<py::str>(arm) || py::hasattr(arm, "__fspath__")) {
    return measured::read_arm_file(arm.cast<std::filesystem::path>(), effects::vocabulary());
  }
  throw py::type_error(
      fmt::format("arm: {}; must be an Arm or the path of an arm file",
                  std::string(py::str(py::type::handle_of(arm).attr("__name__")))));
}

std::vector<arm::Sensor> sensors_of(const py::object& names) {
  if (py::isinstance<py::str>(names)) return {arm::parse_sensor(names.cast<std::string>())};
  std::vector<arm::Sensor> sensors;
  for (const auto& name : names) sensors.push_back(arm::parse_sensor(name.cast<std::string>()));
  return sensors;
}

py::tuple names_of(const std::vector<arm::Sensor>& sensors) {
  py::tuple names(sensors.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) names[i] = arm::to_string(sensors[i]);
  return names;
}

std::vector<arm::Sensor> sensors_or_default(const py::object& names, const arm::Arm& arm) {
  if (!names.is_none()) return sensors_of(names);
  std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle}};
  if (arm::has_beam(arm)) sensors.push_back({arm::SensorKind::tip_acceleration});
  return sensors;
}

namespace {

/// "beam_length_m", the name of an arm's number in Python.
std::string attribute_of(const arm::ArmKey& key) {
  return fmt::format("{}_{}_{}", key.table, key.leaf, unit_in_name(key.unit));
}

/// Sets the numbers that keyword arguments name.
void set_numbers(arm::Arm& arm, const py::kwargs& numbers) {
  std::vector<std::string> names = {"name"};
  for (const auto& key : arm::arm_keys()) names.push_back(attribute_of(key));
  for (const auto& [word, value] : numbers) {
    const auto name = word.cast<std::string>();
    const auto key = std::ranges::find(arm::arm_keys(), name, attribute_of);
    if (key == arm::arm_keys().end()) {
      throw arm::InputError(fmt::format("{}: not a number of an arm{}; allowed: {}",
                                        arm::shown(name), arm::did_you_mean(name, names),
                                        fmt::join(names, ", ")));
    }
    if (value.is_none()) continue;
    try {
      key->set(arm, value.cast<double>());
    } catch (const py::cast_error&) {
      throw py::type_error(fmt::format("{} = {}: must be a number [{}]", name,
                                       std::string(py::repr(value)), key->unit));
    }
  }
}

arm::Arm made(const std::string& name, const py::kwargs& numbers) {
  arm::Arm arm;
  arm.name = name;
  set_numbers(arm, numbers);
  arm::require_valid(arm);
  return arm;
}

arm::Arm with_numbers(const arm::Arm& arm, const std::optional<std::string>& name,
                      const py::kwargs& numbers) {
  arm::Arm changed = arm;
  if (name) changed.name = *name;
  set_numbers(changed, numbers);
  arm::require_valid(changed);
  return changed;
}

arm::Arm with_effect(const arm::Arm& arm, const std::string& effect, const std::string& sensor,
                     const py::kwargs& parameters) {
  arm::Arm changed = arm;
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : parameters) {
    numbers[name.cast<std::string>()] = value.cast<double>();
  }
  effects::put(changed, effect, numbers, sensor);
  arm::require_valid(changed);
  return changed;
}

arm::Arm without_effect(const arm::Arm& arm, const std::string& effect) {
  arm::Arm changed = arm;
  if (changed.effects.erase(effect) > 0) return changed;
  std::vector<std::string> names;
  for (const auto& [name, one] : arm.effects) names.push_back(name);
  throw arm::InputError(
      fmt::format("{}: not an effect of the arm{}; its effects are {}", arm::shown(effect),
                  arm::did_you_mean(effect, names),
                  names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

arm::Arm with_uncertainties(const arm::Arm& arm, const std::map<std::string, double>& relative) {
  arm::Arm changed = arm;
  for (const auto& [key, value] : relative) changed.relative_uncertainties[key] = value;
  arm::require_valid(changed);
  return changed;
}

std::string arm_text(const arm::Arm& arm) {
  std::string text = fmt::format("<flexarm.Arm '{}'", arm.name);
  const arm::LinearArm linear = arm::linear_arm(arm);
  if (arm::has_beam(arm)) {
    text +=
        fmt::format(": l {:g} m, EI {:.6g} N m^2, m {:.6g} kg/m, Ih {:g} kg m^2, Mp {:g} kg",
                    linear.length_m, linear.flexural_rigidity_N_m2, linear.linear_density_kg_per_m,
                    linear.hub_inertia_kg_m2, linear.payload_mass_kg);
  } else {
    text += fmt::format(": rigid hub, Ih {:g} kg m^2", linear.hub_inertia_kg_m2);
  }
  if (!arm.effects.empty()) {
    std::vector<std::string> names;
    for (const auto& [name, effect] : arm.effects) names.push_back(name);
    text += fmt::format(", with {}", fmt::join(names, ", "));
  }
  return text + ">";
}

/// What users see of a row of arm_keys().
struct ArmNumber {
  std::string attribute;
  std::string key;
  std::string symbol;
  std::string unit;
  std::string meaning;
  std::string allowed;
  bool required = false;
};

std::vector<ArmNumber> arm_numbers() {
  std::vector<ArmNumber> numbers;
  for (const auto& key : arm::arm_keys()) {
    numbers.push_back({attribute_of(key), key.name(), key.symbol, key.unit, key.meaning,
                       arm::to_string(key.range), key.required});
  }
  return numbers;
}

void add_arm_numbers(py::module_& module) {
  py::class_<ArmNumber>(module, "ArmNumber", "A number of an arm.")
      .def_readonly("attribute", &ArmNumber::attribute, "Its name in Python: 'beam_length_m'.")
      .def_readonly("key", &ArmNumber::key, "Its key in an arm file: 'beam.length'.")
      .def_readonly("symbol", &ArmNumber::symbol, "As in the equations: 'l'.")
      .def_readonly("unit", &ArmNumber::unit, "Its unit: 'm'.")
      .def_readonly("meaning", &ArmNumber::meaning, "What it is.")
      .def_readonly("allowed", &ArmNumber::allowed, "The values allowed, in words.")
      .def_readonly("required", &ArmNumber::required, "Whether an arm with a beam must give it.")
      .def("__repr__", [](const ArmNumber& number) {
        return fmt::format("<flexarm.ArmNumber {} [{}]: {}>", number.attribute, number.unit,
                           number.meaning);
      });
  module.def("arm_numbers", &arm_numbers, "The numbers of an arm, a list of ArmNumber.");
}

/// "beam_length_m=None, ...": the numbers as keywords of a signature.
std::string number_keywords() {
  std::vector<std::string> names;
  for (const auto& key : arm::arm_keys()) names.push_back(attribute_of(key) + "=None");
  return fmt::format("{}", fmt::join(names, ", "));
}

/// "  beam_length_m: length [m], above 0", a line each.
std::string number_texts() {
  std::string text;
  for (const auto& key : arm::arm_keys()) {
    text += fmt::format("  {}: {} [{}], {}\n", attribute_of(key), key.meaning, key.unit,
                        arm::to_string(key.range));
  }
  return text;
}

template <class Class>
void add_numbers(Class& type) {
  for (const auto& key : arm::arm_keys()) {
    const std::string doc = fmt::format("{} [{}]: {}. None where the arm does not give it.",
                                        key.symbol, key.unit, key.meaning);
    type.def_property_readonly(attribute_of(key).c_str(), key.get, doc.c_str());
  }
}

}  // namespace

void add_arm(py::module_& module) {
  using arm::Arm;
  py::class_<Arm> type(
      module, "Arm",
      ("A single-link flexible manipulator: a uniform beam turned about its root by a motor, with "
       "a "
       "payload at its tip. An arm does not change: with_ and with_effect return another.\n\n"
       "Arguments, the numbers of an arm file (docs/formats.md); None: not given:\n"
       "  name: its name\n" +
       number_texts() +
       "\nRaises InputError for a number that is missing, out of its range or does not fit the "
       "others.")
          .c_str());
  type.def(py::init(&made), py::arg("name") = "", (number_keywords() + "\n--\n\n").c_str())
      .def_static("paper", &arm::paper_arm, "The arm of the paper's Table 1: an aluminium link.")
      .def_static(
          "from_toml",
          [](const std::string& text) {
            return measured::parse_arm(text, "<string>", effects::vocabulary());
          },
          py::arg("text"),
          "The arm of the text of an arm file. Raises InputError with '<string>:LINE: ' in "
          "front.\n\n"
          "Arguments:\n  text: that of an arm file")
      .def(
          "to_toml", &measured::format_arm,
          "The arm as the text of an arm file; from_toml reads the same arm back, every number bit "
          "for bit.")
      .def("write", &measured::write_arm_file, py::arg("path"),
           "Writes an arm file, whole or not at all. Raises InputError where it cannot be "
           "written.\n\n"
           "Arguments:\n  path: that of the file")
      .def(
          "with_", &with_numbers, py::arg("name") = py::none(),
          (number_keywords() +
           "\n--\n\nThe arm with other numbers: arm.with_(payload_mass_kg=0.05). Raises InputError "
           "as Arm().\n\nArguments:\n  name: its name; None: as it is\n" +
           number_texts())
              .c_str())
      .def(
          "with_effect", &with_effect, py::arg("effect"), py::arg("sensor") = "",
          "**parameters\n--\n\nThe arm with an effect: "
          "arm.with_effect('root_compliance', stiffness=30.0). Raises InputError for an unknown "
          "effect or parameter, and a value out of its range.\n\n"
          "Arguments:\n  effect: its name\n"
          "  sensor: name of the sensor that it acts on, where it acts on one\n"
          "  **parameters: numbers with the names and units of docs/effects.md; those that are not "
          "given keep the value that the arm has, or their default")
      .def("without_effect", &without_effect, py::arg("effect"),
           "The arm without an effect that it has. Raises InputError where it has not.\n\n"
           "Arguments:\n  effect: its name")
      .def("with_uncertainties", &with_uncertainties, py::arg("relative"),
           "The arm with relative standard deviations of numbers, by their key in an arm file: "
           "{'hub.inertia': 0.05}. A diagnosis refits such numbers. Raises InputError for "
           "an unknown key and a value that is not above 0.\n\nArguments:\n"
           "  relative: a dict of standard deviations relative to the numbers [1]")
      .def_property_readonly(
          "name", [](const Arm& arm) { return arm.name; }, "Its name.")
      .def_property_readonly(
          "effects", [](const Arm& arm) { return arm.effects; },
          "The effects of the arm by name, a dict of Effect.")
      .def_property_readonly(
          "uncertainties", [](const Arm& arm) { return arm.relative_uncertainties; },
          "Relative standard deviations of numbers by their key in an arm file, a dict.")
      .def_property_readonly("has_beam", &arm::has_beam,
                             "False for a rigid hub: an arm whose file has no [beam].")
      .def_property_readonly(
          "flexural_rigidity_N_m2",
          [](const Arm& arm) { return arm::linear_arm(arm).flexural_rigidity_N_m2; },
          "EI [N m^2], linear effects included.")
      .def_property_readonly(
          "linear_density_kg_per_m",
          [](const Arm& arm) { return arm::linear_arm(arm).linear_density_kg_per_m; },
          "m [kg/m], linear effects included.")
      .def_property_readonly(
          "total_inertia_kg_m2", [](const Arm& arm) { return arm::total_inertia_kg_m2(arm); },
          "I_T [kg m^2]: inertia of the rigid arm about the motor axis, linear effects included.")
      .def_property_readonly("hub_inertia_ratio", &arm::hub_inertia_ratio, "epsilon = Ih/(m l^3).")
      .def_property_readonly("payload_mass_ratio", &arm::payload_mass_ratio, "eta = Mp/(m l).")
      .def_property_readonly("payload_inertia_ratio", &arm::payload_inertia_ratio, "Ip/(m l^3).")
      .def_property_readonly("plausibility_notes", &arm::plausibility_notes,
                             "What is unusual about the numbers, a list of sentences.")
      .def(py::self == py::self)
      .def("__hash__", [](const Arm& arm) { return py::hash(py::str(measured::format_arm(arm))); })
      .def("__repr__", &arm_text)
      .def(py::pickle(&measured::format_arm, [](const std::string& text) {
        return measured::parse_arm(text, "<pickle>", effects::vocabulary());
      }));
  add_numbers(type);
  add_arm_numbers(module);
  module.def(
      "read_arm",
      [](const std::filesystem::path& path) {
        return measured::read_usable_arm(path, effects::vocabulary());
      },
      py::arg("path"),
      "Reads an arm file (TOML, docs/formats.md). Raises InputError 'FILE:LINE: ...' for a file "
      "that cannot be read, and for an arm that no formulation takes.\n\nArguments:\n"
      "  path: that of the file");
}

}  // namespace flexarm::python
