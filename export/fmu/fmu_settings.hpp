#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "response/time/cosimulated_arm.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::fmu {

/// How an FMU simulates its arm, as `flexarm simulate`: resources/settings.toml of the archive.
struct FmuSettings {
  std::string formulation = "exact_tf";
  int modes = 5;  ///< flexible ones
  bool static_correction = false;
  double sample_time_s = 5e-4;
  std::vector<arm::Sensor> sensors = {};  ///< the outputs, in this order
  std::string token = {};                 ///< GUID of FMI 2.0, instantiation token of FMI 3.0

  bool operator==(const FmuSettings&) const = default;
};

inline constexpr std::string_view kArmFile = "arm.toml";
inline constexpr std::string_view kSettingsFile = "settings.toml";

std::string format_settings(const FmuSettings& settings);
/// Reads what `format_settings` wrote. Throws InputError, which begins with `file_name`, for
/// anything else.
FmuSettings parse_settings(std::string_view toml, const std::string& file_name);

/// The arm as the FMU simulates it. Throws InputError as `flexarm simulate` refuses an arm: by the
/// name of effect and port where one cannot be honoured.
response::CosimulatedArm make_cosimulated(const arm::Arm& arm, const FmuSettings& settings);

}  // namespace flexarm::fmu
