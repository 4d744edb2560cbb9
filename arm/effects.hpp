#pragma once

#include "arm/range.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::arm {

/// One parameter of an effect, with the range that an arm file may give it.
struct EffectParameter {
  std::string name;
  std::string unit;
  Range range;
  bool required;  ///< must be given in the arm file
};

/// What an effect changes, and with it who honours it.
enum class EffectPlace {
  linear_arm,     ///< the linear equations of the arm: arm/linear_arm.hpp, every formulation
  nonlinear_arm,  ///< forces on hub or beam that are not linear: simulation in time
  actuator,       ///< between the commanded torque and the hub
  sensor,         ///< between a sensor and its reading
};

/// One entry of the vocabulary of causes (docs/formats.md).
struct EffectDefinition {
  std::string name;
  EffectPlace place;
  std::vector<EffectParameter> parameters;
  std::string meaning;  ///< half a sentence for the reader of an arm file
  /// Takes the key `sensor` too, the name of the sensor it acts on; tip_acceleration unless given.
  bool acts_on_sensor = false;
};

/// The whole vocabulary, in the order of docs/formats.md.
const std::vector<EffectDefinition>& effect_vocabulary();

/// The vocabulary's entry of that name, or null.
const EffectDefinition* find_effect(std::string_view name);

/// An effect that is switched on: its numbers by parameter name, and the sensor it acts on where
/// it acts on one (empty means the vocabulary's default).
struct Effect {
  std::map<std::string, double> parameters;
  std::string sensor;

  bool operator==(const Effect&) const = default;
};

/// The effects that extend an arm, by name. A formulation honours each or refuses it by name.
using Effects = std::map<std::string, Effect>;

/// Throws InputError for an unknown effect, an unknown or missing parameter, or a value out of
/// range.
void require_valid(const Effects& effects);

/// Throws InputError that names the first effect which `formulation` cannot honour; `honoured`
/// lists the names it can.
void require_honoured(const Effects& effects, std::string_view formulation,
                      const std::vector<std::string_view>& honoured);

}  // namespace flexarm::arm
