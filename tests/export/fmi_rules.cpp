#include "tests/export/fmi_rules.hpp"

#include "tests/export/fmi_schema.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace flexarm::testing_export {

namespace {

using fmu::FmiVersion;
using Faults = std::vector<std::string>;

template <class Number>
bool is_number(const std::string& text) {
  Number value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

bool is_of_type(const std::string& value, const std::string& type) {
  if (type == "string") return true;
  if (type == "normalizedString") return value.find_first_of("\t\r\n") == std::string::npos;
  if (type == "boolean") return value == "true" || value == "false";
  if (type == "double") return is_number<double>(value);
  if (type == "int") return is_number<int>(value);
  if (type == "unsignedInt") return is_number<unsigned>(value);
  const auto words = words_of(value);
  if (type == "list of unsignedInt") return std::ranges::all_of(words, is_number<unsigned>);
  if (type == "list of kinds") {
    return std::ranges::all_of(words, [](const std::string& word) {
      return is_of_type(word, "dependent|constant|fixed|tunable|discrete");
    });
  }
  std::istringstream choices(type);
  for (std::string choice; std::getline(choices, choice, '|');) {
    if (choice == value) return true;
  }
  return false;
}

void check_element(const XmlNode& node, const Schema& schema, Faults& faults) {
  const auto found = schema.find(node.name);
  if (found == schema.end()) {
    faults.push_back(node.name + ": unknown element");
    return;
  }
  const ElementRule& rule = found->second;
  for (const auto& [name, value] : node.attributes) {
    const auto attribute = rule.attributes.find(name);
    if (attribute == rule.attributes.end()) {
      faults.push_back(node.name + ": unknown attribute " + name);
    } else if (!is_of_type(value, attribute->second.type)) {
      faults.push_back(node.name + ": " + name + " = " + value + " is not of type " +
                       attribute->second.type);
    }
  }
  for (const auto& [name, attribute] : rule.attributes) {
    if (attribute.is_required && !node.has(name)) {
      faults.push_back(node.name + ": attribute " + name + " is missing");
    }
  }
  if (rule.holds_anything) return;
  std::size_t at = 0;
  for (const ChildRule& child : rule.children) {
    int count = 0;
    for (; at < node.children.size() && node.children[at].name == child.name; ++at) ++count;
    if (count < child.least || count > child.most) {
      faults.push_back(node.name + ": " + std::to_string(count) + " elements " + child.name);
    }
  }
  if (at < node.children.size()) {
    faults.push_back(node.name + ": " + node.children[at].name + " may not stand there");
  }
  for (const XmlNode& child : node.children) check_element(child, schema, faults);
}

void check_unique(const std::vector<XmlNode>& nodes, const std::string& attribute, Faults& faults) {
  std::set<std::string> seen;
  for (const XmlNode& node : nodes) {
    if (seen.insert(node.get(attribute)).second) continue;
    faults.push_back(attribute + " " + node.get(attribute) + " is not unique");
  }
}

/// Names of the convention "structured": identifiers, or quoted ones, with dots between.
bool is_structured(const std::string& name) {
  const auto is_letter = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
  };
  std::size_t i = 0;
  while (true) {
    if (i < name.size() && name[i] == '\'') {
      const std::size_t end = name.find('\'', i + 1);
      if (end == std::string::npos || end == i + 1) return false;
      i = end + 1;
    } else {
      if (i >= name.size() || !is_letter(name[i])) return false;
      while (i < name.size() &&
             (is_letter(name[i]) || std::isdigit(static_cast<unsigned char>(name[i]))))
        ++i;
    }
    if (i == name.size()) return true;
    if (name[i++] != '.') return false;
  }
}

/// A variable with what it says of its value, wherever the version has that.
struct Variable {
  const XmlNode& head;
  const XmlNode& value;

  std::string name() const { return head.get("name"); }
  bool is(const std::string& causality) const { return head.get("causality") == causality; }
};

/// The table of causality, variability and initial of the standard (FMI 2.0.x, section 2.2.7; FMI
/// 3.0.x, section 2.4.7.5), for what is given in full.
bool is_combination(const Variable& variable) {
  const std::string causality = variable.head.get("causality");
  const std::string variability = variable.head.get("variability");
  const std::string initial = variable.head.get("initial");
  if (causality == "parameter") {
    return (variability == "fixed" || variability == "tunable") && initial == "exact";
  }
  if (causality == "input") {
    return (variability == "discrete" || variability == "continuous") && initial.empty();
  }
  if (causality == "independent") return variability == "continuous" && initial.empty();
  if (causality == "output") {
    if (variability == "constant") return initial == "exact";
    return (variability == "discrete" || variability == "continuous") && !initial.empty();
  }
  return false;  // this checker knows no other
}

void check_variables(const XmlNode& root, const std::vector<Variable>& variables,
                     FmiVersion version, Faults& faults) {
  std::set<std::string> units;
  for (const XmlNode& unit : root.one("UnitDefinitions").children) units.insert(unit.get("name"));
  int independent = 0;
  for (const Variable& variable : variables) {
    const std::string name = variable.name();
    if (!is_combination(variable)) faults.push_back(name + ": causality, variability, initial");
    const bool has_start = variable.value.has("start");
    const bool needs_start = variable.is("parameter") || variable.is("input") ||
                             variable.head.get("initial") == "exact" ||
                             variable.head.get("initial") == "approx";
    if (has_start != needs_start) faults.push_back(name + ": start value");
    if (has_start && variable.value.has("min") &&
        std::stod(variable.value.get("start")) < std::stod(variable.value.get("min"))) {
      faults.push_back(name + ": start value below min");
    }
    if (variable.value.has("unit") && !units.contains(variable.value.get("unit"))) {
      faults.push_back(name + ": unit " + variable.value.get("unit") + " is not defined");
    }
    if (root.get("variableNamingConvention") == "structured" && !is_structured(name)) {
      faults.push_back(name + ": not a structured name");
    }
    if (variable.is("independent")) ++independent;
  }
  // FMI 3.0: exactly one; FMI 2.0: at most one.
  if (independent > 1 || (version == FmiVersion::v3 && independent != 1)) {
    faults.push_back("independent variable: " + std::to_string(independent));
  }
}

void check_unknowns(const std::vector<const XmlNode*>& unknowns, const std::string& what,
                    const std::set<std::string>& expected, const std::set<std::string>& knowns,
                    const std::string& key, Faults& faults) {
  std::vector<std::string> order;
  for (const XmlNode* unknown : unknowns) {
    order.push_back(unknown->get(key));
    if (unknown->has("dependenciesKind") && words_of(unknown->get("dependencies")).size() !=
                                                words_of(unknown->get("dependenciesKind")).size()) {
      faults.push_back(what + ": dependenciesKind has another length than dependencies");
    }
    for (const std::string& known : words_of(unknown->get("dependencies"))) {
      if (!knowns.contains(known)) faults.push_back(what + ": depends on " + known);
    }
  }
  if (std::set<std::string>(order.begin(), order.end()) != expected ||
      order.size() != expected.size()) {
    faults.push_back(what + ": not exactly the variables that it must have");
  }
  if (!std::ranges::is_sorted(order, {}, [](const std::string& at) { return std::stoul(at); })) {
    faults.push_back(what + ": not in the order of the variables");
  }
}

void check_structure(const XmlNode& root, const std::vector<Variable>& variables,
                     FmiVersion version, Faults& faults) {
  const bool is_v2 = version == FmiVersion::v2;
  std::set<std::string> outputs;
  std::set<std::string> knowns;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::string key = is_v2 ? std::to_string(i + 1) : variables[i].head.get("valueReference");
    if (variables[i].is("output")) outputs.insert(key);
    if (variables[i].is("input") || variables[i].is("independent")) knowns.insert(key);
  }
  const XmlNode& structure = root.one("ModelStructure");
  const std::string key = is_v2 ? "index" : "valueReference";
  check_unknowns(is_v2 ? structure.one("Outputs").all("Unknown") : structure.all("Output"),
                 "Outputs", outputs, knowns, key, faults);
  // All outputs are calculated, so that all are unknown at the start.
  check_unknowns(
      is_v2 ? structure.one("InitialUnknowns").all("Unknown") : structure.all("InitialUnknown"),
      "InitialUnknowns", outputs, knowns, key, faults);
}

}  // namespace

Faults faults_of(const XmlNode& root, FmiVersion version) {
  Faults faults;
  if (root.name != "fmiModelDescription") return {"root element " + root.name};
  check_element(root, schema_of(version), faults);
  if (!faults.empty()) return faults;
  const auto& nodes = root.one("ModelVariables").children;
  std::vector<Variable> variables;
  for (const XmlNode& node : nodes) {
    variables.push_back({node, version == FmiVersion::v2 ? node.one("Real") : node});
  }
  check_unique(nodes, "name", faults);
  check_unique(nodes, "valueReference", faults);
  check_unique(root.one("UnitDefinitions").children, "name", faults);
  check_variables(root, variables, version, faults);
  check_structure(root, variables, version, faults);
  return faults;
}

Faults faults_of_build(const XmlNode& root) {
  Faults faults;
  if (root.name != "fmiBuildDescription") return {"root element " + root.name};
  check_element(root, build_schema(), faults);
  return faults;
}

}  // namespace flexarm::testing_export
