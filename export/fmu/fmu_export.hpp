#pragma once

#include "arm/arm.hpp"
#include "export/fmu/fmu_settings.hpp"
#include "export/fmu/model_description.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace flexarm::fmu {

/// What an FMU is made of.
struct FmuRequest {
  arm::Arm arm;
  FmuSettings settings;  ///< without token, which follows from everything else
  FmiVersion version = FmiVersion::v2;
  /// The name of the shared library within, and of the model where the arm has none: letters,
  /// digits and _.
  std::string model_identifier;
  /// Standard deviations of parameters by variable name, in their units, beside those that the arm
  /// states of its numbers.
  std::map<std::string, double> standard_deviations = {};
};

struct Fmu {
  std::string archive;  ///< the bytes of the file
  FmuDescription description;
};

/// The same request gives the same bytes. Throws InputError for an arm, sensors or settings that
/// `flexarm simulate` would refuse, by the name of the effect where one cannot be honoured.
Fmu make_fmu(const FmuRequest& request);

/// "arm_2" of "arm-2": a C identifier.
std::string identifier_of(const std::string& text);

}  // namespace flexarm::fmu
