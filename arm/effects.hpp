#pragma once

#include "arm/hub_torque_formula.hpp"
#include "arm/hub_torque_table.hpp"
#include "arm/ports.hpp"
#include "arm/range.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::arm {

struct Arm;
struct EffectDefinition;

/// One parameter of an effect.
struct EffectParameter {
  std::string name;
  std::string unit;
  Range range;          ///< that an arm file may give it
  std::string meaning;  ///< half a sentence
  double example;       ///< a size that shows on an arm like the paper's
  /// Where the effect does nothing, whatever its other parameters: 0, 1, infinity.
  std::optional<double> neutral = {};
  /// Its value where the arm file does not give it; empty: the file must.
  std::optional<double> otherwise = {};
};

/// An effect that is switched on: which one, its numbers by parameter name, and the sensor it acts
/// on where it acts on one (empty: the definition's).
struct Effect {
  std::shared_ptr<const EffectDefinition> definition;
  std::map<std::string, double> parameters = {};
  std::string sensor = {};

  /// The parameter's number, or what stands for it where it is not given.
  double value(const std::string& parameter) const;
  /// The sensor it acts on. Throws InputError for a name that is no sensor's.
  Sensor acting_sensor() const;

  /// Definitions are the same, or stand alike in an arm file.
  bool operator==(const Effect& other) const;
};

/// What an effect is and does: data and a function for each port that it acts through. An effect
/// that acts through a port is honoured wherever that port is, so that it needs no line elsewhere.
struct EffectDefinition {
  std::string name;
  std::string meaning;  ///< half a sentence, or an equation
  std::vector<EffectParameter> parameters;
  /// Acts on one sensor: this one, unless the arm file's key `sensor` names another.
  std::optional<Sensor> sensor = {};
  /// What an arm file states where it defines the effect itself (arm/given_effects.hpp).
  std::variant<std::monostate, HubTorqueFormula, HubTorqueTable> given = {};

  std::function<void(const Effect&, Arm&)> arm_number = {};
  /// The arm is given with the numbers that effects change.
  std::function<void(const Effect&, const Arm&, LinearTerms&)> linear_term = {};
  std::function<SensorPlace(const Effect&)> sensor_place = {};
  std::function<TorqueStage(const Effect&)> torque_path = {};
  std::function<HubLaw(const Effect&)> hub_torque = {};
  std::function<BeamForce(const Effect&)> beam_force = {};
  std::function<SensorStage(const Effect&)> sensor_path = {};

  /// Throws InputError where the effect's numbers do not fit the arm, which is given with changed
  /// numbers.
  std::function<void(const Effect&, const Arm&)> require_fit = {};

  /// The ports that it acts through, one or more.
  std::vector<Port> ports() const;
  /// All of them are of the linear arm: the equations that every formulation solves, and where
  /// gauges are on it.
  bool is_of_linear_arm() const;
};

/// The effect with a definition of its own, as `change` leaves it.
Effect redefined(const Effect& effect, const std::function<void(EffectDefinition&)>& change);

/// Effects by name, as `[effects.NAME]` of an arm file.
using Effects = std::map<std::string, Effect>;

/// The definitions that an arm file may use.
using Vocabulary = std::vector<std::shared_ptr<const EffectDefinition>>;

/// The vocabulary's entry of that name, or null.
std::shared_ptr<const EffectDefinition> find_effect(const Vocabulary& vocabulary,
                                                    std::string_view name);

/// "unknown effect (did you mean ...?); allowed: ..."
std::string unknown_effect(const Vocabulary& vocabulary, std::string_view name);

/// Throws InputError for an unknown or missing parameter, or a value out of its range.
void require_valid(const Effects& effects);

/// Throws InputError that names the first effect, and its port, that `who` cannot honour: one that
/// acts through a port which is not among `honoured`.
void require_honoured(const Effects& effects, std::string_view who, std::span<const Port> honoured);

}  // namespace flexarm::arm
