#pragma once

#include "arm/arm.hpp"
#include "arm/range.hpp"
#include "arm/sensor.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::fmu {

enum class Causality { independent, input, output, parameter };

/// The standard's word for it.
std::string_view word_for(Causality causality);

/// A variable of an FMU; its value reference is its place among `fmu_variables`.
struct FmuVariable {
  /// As in an arm file: "torque", "hub_angle", "beam.length", "effects.coulomb_friction.torque"; in
  /// quotes where FMI's structured names ask for them: "'strain@0.05'".
  std::string name;
  Causality causality;
  std::string unit;
  std::string meaning;
  double start = 0.0;                    ///< of inputs and parameters
  std::optional<arm::Range> range = {};  ///< of parameters
  bool follows_torque = false;           ///< an output that jumps with the torque
};

/// Time, the torque, the sensors in their order, and as parameters the numbers that the arm gives
/// and those of its effects.
std::vector<FmuVariable> fmu_variables(const arm::Arm& arm, std::span<const arm::Sensor> sensors);

inline constexpr std::uint32_t kTimeReference = 0;
inline constexpr std::uint32_t kTorqueReference = 1;
inline constexpr std::uint32_t kFirstOutputReference = 2;

/// Gives the arm another value of a parameter. Throws InputError for a value that is out of its
/// range.
void set_parameter(arm::Arm& arm, const FmuVariable& parameter, double value);

}  // namespace flexarm::fmu
