#include "export/fmu/model_description.hpp"

#include "export/fmu/si_unit.hpp"
#include "export/fmu/xml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace flexarm::fmu {

namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// The name of the annotations of these documents.
constexpr const char* kVendor = "flexarm";
constexpr const char* kAnnotationType = "flexarm.uncertainty";
/// Of a default experiment, which the standard asks no more of than to be useful.
constexpr double kStopTime_s = 2.0;

XmlElement units_of(const FmuDescription& fmu) {
  XmlElement made{"UnitDefinitions"};
  std::vector<std::string> names;
  for (const FmuVariable& variable : fmu.variables) {
    if (std::ranges::find(names, variable.unit) != names.end()) continue;
    names.push_back(variable.unit);
    XmlElement& unit = made.add({"Unit", {{"name", variable.unit}}});
    const auto si = parse_si_unit(variable.unit);
    if (!si) continue;
    XmlElement& base = unit.add({"BaseUnit"});
    for (const char* const symbol : {"kg", "m", "s", "A", "K", "rad"}) {
      const auto exponent = si->exponents.find(symbol);
      if (exponent == si->exponents.end()) continue;
      base.attributes.emplace_back(symbol, std::to_string(exponent->second));
    }
    if (si->factor != 1.0) base.attributes.emplace_back("factor", xml_number(si->factor));
  }
  return made;
}

/// The standard deviation of a parameter, or null.
const double* deviation_of(const FmuDescription& fmu, const FmuVariable& variable) {
  const auto found = fmu.standard_deviations.find(variable.name);
  return found == fmu.standard_deviations.end() ? nullptr : &found->second;
}

std::string meaning_of(const FmuDescription& fmu, const FmuVariable& variable) {
  const double* const deviation = deviation_of(fmu, variable);
  if (deviation == nullptr) return variable.meaning;
  return fmt::format("{}; standard deviation {:.3g} {}", variable.meaning, *deviation,
                     variable.unit);
}

std::string variability_of(const FmuVariable& variable) {
  return variable.causality == Causality::parameter ? "fixed" : "continuous";
}

/// "exact", "calculated", or "" where the standard has none.
std::string initial_of(const FmuVariable& variable) {
  switch (variable.causality) {
    case Causality::parameter:
      return "exact";
    case Causality::output:
      return "calculated";
    default:
      return "";
  }
}

bool has_start(const FmuVariable& variable) {
  return variable.causality == Causality::parameter || variable.causality == Causality::input;
}

/// Unit, least value and start value.
Attributes value_attributes(const FmuVariable& variable) {
  Attributes made = {{"unit", variable.unit}};
  if (variable.range && variable.range->minimum == 0.0) made.emplace_back("min", "0");
  if (has_start(variable)) made.emplace_back("start", xml_number(variable.start));
  return made;
}

Attributes head_attributes(const FmuDescription& fmu, const FmuVariable& variable,
                           std::size_t reference) {
  Attributes made = {{"name", variable.name},
                     {"valueReference", std::to_string(reference)},
                     {"description", meaning_of(fmu, variable)},
                     {"causality", std::string(word_for(variable.causality))},
                     {"variability", variability_of(variable)}};
  if (const std::string initial = initial_of(variable); !initial.empty()) {
    made.emplace_back("initial", initial);
  }
  return made;
}

XmlElement uncertainty(double deviation) {
  return {"Uncertainty", {{"standardDeviation", xml_number(deviation)}}};
}

XmlElement variables_of(const FmuDescription& fmu, FmiVersion version) {
  XmlElement made{"ModelVariables"};
  for (std::size_t i = 0; i < fmu.variables.size(); ++i) {
    const FmuVariable& variable = fmu.variables[i];
    const double* const deviation = deviation_of(fmu, variable);
    Attributes head = head_attributes(fmu, variable, i);
    Attributes value = value_attributes(variable);
    if (version == FmiVersion::v2) {
      XmlElement& scalar = made.add({"ScalarVariable", std::move(head)});
      scalar.add({"Real", std::move(value)});
      if (deviation == nullptr) continue;
      scalar.add({"Annotations", {}, {{"Tool", {{"name", kVendor}}, {uncertainty(*deviation)}}}});
    } else {
      head.insert(head.end(), value.begin(), value.end());
      XmlElement& scalar = made.add({"Float64", std::move(head)});
      if (deviation == nullptr) continue;
      scalar.add({"Annotations",
                  {},
                  {{"Annotation", {{"type", kAnnotationType}}, {uncertainty(*deviation)}}}});
    }
  }
  return made;
}

/// What names variable `i` in a model structure: in FMI 2.0 its place from 1, in 3.0 its value
/// reference.
std::string key_of(std::size_t i, FmiVersion version) {
  return std::to_string(version == FmiVersion::v2 ? i + 1 : i);
}

XmlElement structure_of(const FmuDescription& fmu, FmiVersion version) {
  const bool is_v2 = version == FmiVersion::v2;
  const std::string attribute = is_v2 ? "index" : "valueReference";
  std::vector<XmlElement> outputs;
  std::vector<XmlElement> unknowns;
  for (std::size_t i = 0; i < fmu.variables.size(); ++i) {
    const FmuVariable& variable = fmu.variables[i];
    if (variable.causality != Causality::output) continue;
    const std::string key = key_of(i, version);
    XmlElement& output =
        outputs.emplace_back(XmlElement{is_v2 ? "Unknown" : "Output", {{attribute, key}}});
    if (variable.follows_torque) {
      output.attributes.emplace_back("dependencies", key_of(kTorqueReference, version));
      output.attributes.emplace_back("dependenciesKind", "dependent");
    } else {
      output.attributes.emplace_back("dependencies", "");
    }
    // At the start they depend on torque and parameters, which is what no list says.
    unknowns.push_back({is_v2 ? "Unknown" : "InitialUnknown", {{attribute, key}}});
  }
  if (is_v2) {
    return {"ModelStructure", {}, {{"Outputs", {}, outputs}, {"InitialUnknowns", {}, unknowns}}};
  }
  XmlElement made{"ModelStructure", {}, std::move(outputs)};
  std::ranges::move(unknowns, std::back_inserter(made.children));
  return made;
}

XmlElement interface_of(const FmuDescription& fmu, FmiVersion version) {
  XmlElement made{"CoSimulation", {{"modelIdentifier", fmu.model_identifier}}};
  const auto add = [&](const char* name, const std::string& value) {
    made.attributes.emplace_back(name, value);
  };
  add("canHandleVariableCommunicationStepSize", "true");
  if (version == FmiVersion::v3) {
    add("canGetAndSetFMUState", "true");
    add("canSerializeFMUState", "true");
    add("fixedInternalStepSize", xml_number(fmu.settings.sample_time_s));
    return made;
  }
  add("canNotUseMemoryManagementFunctions", "true");
  add("canGetAndSetFMUstate", "true");
  add("canSerializeFMUstate", "true");
  XmlElement& sources = made.add({"SourceFiles"});
  for (const std::string& file : fmu.source_files) sources.add({"File", {{"name", file}}});
  return made;
}

/// How the arm is simulated, for whoever reads the file.
XmlElement settings_of(const FmuDescription& fmu) {
  const FmuSettings& settings = fmu.settings;
  return {"Simulation",
          {{"formulation", settings.formulation},
           {"modes", std::to_string(settings.modes)},
           {"staticCorrection", settings.static_correction ? "true" : "false"},
           {"sampleTime", xml_number(settings.sample_time_s)}}};
}

}  // namespace

std::string model_description(const FmuDescription& fmu, FmiVersion version) {
  const bool is_v2 = version == FmiVersion::v2;
  XmlElement root{"fmiModelDescription",
                  {{"fmiVersion", is_v2 ? "2.0" : "3.0"},
                   {"modelName", fmu.model_name},
                   {is_v2 ? "guid" : "instantiationToken", fmu.settings.token},
                   {"description", fmu.description},
                   {"generationTool", fmu.generation_tool},
                   {"variableNamingConvention", "structured"}}};
  root.add(interface_of(fmu, version));
  root.add(units_of(fmu));
  root.add({"LogCategories",
            {},
            {{"Category", {{"name", "logStatusError"}, {"description", "why a call failed"}}}}});
  root.add({"DefaultExperiment",
            {{"startTime", "0"},
             {"stopTime", xml_number(kStopTime_s)},
             {"stepSize", xml_number(fmu.settings.sample_time_s)}}});
  if (is_v2) {
    root.add({"VendorAnnotations", {}, {{"Tool", {{"name", kVendor}}, {settings_of(fmu)}}}});
  }
  root.add(variables_of(fmu, version));
  root.add(structure_of(fmu, version));
  if (!is_v2) {
    root.add({"Annotations",
              {},
              {{"Annotation", {{"type", "flexarm.simulation"}}, {settings_of(fmu)}}}});
  }
  return xml_document(root);
}

std::string build_description(const FmuDescription& fmu) {
  XmlElement files{"SourceFileSet", {{"language", "C++20"}}};
  for (const std::string& file : fmu.source_files) files.add({"SourceFile", {{"name", file}}});
  files.add({"IncludeDirectory", {{"name", "."}}});
  const XmlElement library{
      "Library",
      {{"name", "flexarm"},
       {"external", "true"},
       {"description", "an installed flexarm; CMakeLists.txt beside this file finds it"}}};
  return xml_document({"fmiBuildDescription",
                       {{"fmiVersion", "3.0"}},
                       {{"BuildConfiguration",
                         {{"modelIdentifier", fmu.model_identifier}},
                         {std::move(files), library}}}});
}

}  // namespace flexarm::fmu
