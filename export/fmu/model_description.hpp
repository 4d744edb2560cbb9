#pragma once

#include "export/fmu/fmu_settings.hpp"
#include "export/fmu/fmu_variables.hpp"

#include <map>
#include <string>
#include <vector>

namespace flexarm::fmu {

/// Of the Functional Mock-up Interface [FMI2, FMI3].
enum class FmiVersion { v2, v3 };

/// What a model description says.
struct FmuDescription {
  std::string model_name;
  std::string model_identifier;  ///< of a C identifier's form; the binary's name
  std::string description;
  std::string generation_tool;
  FmuSettings settings;
  std::vector<FmuVariable> variables;
  /// Standard deviations of parameters, by name, in their units.
  std::map<std::string, double> standard_deviations;
  std::vector<std::string> source_files;  ///< below sources/, those to be compiled
};

/// modelDescription.xml, by the rules of fmi2ModelDescription.xsd of FMI 2.0.x or
/// fmi3ModelDescription.xsd of FMI 3.0.x.
std::string model_description(const FmuDescription& fmu, FmiVersion version);

/// sources/buildDescription.xml of FMI 3.0 (fmi3BuildDescription.xsd).
std::string build_description(const FmuDescription& fmu);

}  // namespace flexarm::fmu
