#pragma once

#include "arm/arm.hpp"
#include "export/samples/parameter_posterior.hpp"

#include <map>
#include <string>

namespace flexarm::app {

/// The arm that a command exports.
struct ExportedArm {
  arm::Arm arm;
  samples::ParameterPosterior posterior;

  /// Of its numbers and of its effects' parameters, by key, in their units.
  std::map<std::string, double> standard_deviations() const;
};

/// Reads an arm file, or the JSON of a diagnosis (*.json) and beside it the file of its extended
/// arm. Throws InputError for a file that is neither, and a diagnosis without an extended arm.
ExportedArm read_exported_arm(const std::string& file);

}  // namespace flexarm::app
