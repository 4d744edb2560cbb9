#pragma once

#include "arm/arm.hpp"

#include <map>
#include <string>

namespace flexarm::app {

/// The arm that a command exports.
struct ExportedArm {
  arm::Arm arm;
  /// Of its numbers and of its effects' parameters, "effects.coulomb_friction.torque", in their
  /// units, where a diagnosis says them.
  std::map<std::string, double> standard_deviations = {};
};

/// Reads an arm file, or the JSON of a diagnosis (*.json) and beside it the file of its extended
/// arm. Throws InputError for a file that is neither, and a diagnosis without an extended arm.
ExportedArm read_exported_arm(const std::string& file);

}  // namespace flexarm::app
