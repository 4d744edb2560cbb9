#include "export/fmu/fmu_variables.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace flexarm::fmu {

namespace {

constexpr std::string_view kEffects = "effects.";

std::string meaning_of(const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
      return "angle of the hub";
    case arm::SensorKind::hub_velocity:
      return "angular velocity of the hub";
    case arm::SensorKind::tip_acceleration:
      return "acceleration of the tip across the arm";
    case arm::SensorKind::tip_displacement:
      return "displacement of the tip, hub rotation included";
    case arm::SensorKind::tip_deflection:
      return "displacement of the tip less length times hub angle";
    case arm::SensorKind::strain:
      return fmt::format("surface strain of the beam, {} m from the motor axis", sensor.position_m);
  }
  return "";
}

/// A name of FMI's variable naming convention "structured".
std::string structured_name(const arm::Sensor& sensor) {
  const std::string name = arm::to_string(sensor);
  return name.find('@') == std::string::npos ? name : "'" + name + "'";
}

std::string name_of(const std::string& effect, const std::string& parameter) {
  return fmt::format("{}{}.{}", kEffects, effect, parameter);
}

}  // namespace

std::string_view word_for(Causality causality) {
  switch (causality) {
    case Causality::independent:
      return "independent";
    case Causality::input:
      return "input";
    case Causality::output:
      return "output";
    case Causality::parameter:
      return "parameter";
  }
  return "";
}

std::vector<FmuVariable> fmu_variables(const arm::Arm& arm, std::span<const arm::Sensor> sensors) {
  std::vector<FmuVariable> made = {
      {"time", Causality::independent, "s", "since the start of the simulation"},
      {"torque", Causality::input, "N m",
       "commanded torque on the hub, constant between communication points"}};
  for (const arm::Sensor& sensor : sensors) {
    made.push_back({.name = structured_name(sensor),
                    .causality = Causality::output,
                    .unit = std::string(arm::unit(sensor)),
                    .meaning = meaning_of(sensor),
                    .follows_torque = arm::derivative_order(sensor) == 2});
  }
  for (const arm::ArmKey& key : arm::arm_keys()) {
    const std::optional<double> value = key.get(arm);
    if (!value || (key.table != "hub" && !arm::has_beam(arm))) continue;
    made.push_back({key.name(), Causality::parameter, key.unit, key.meaning, *value, key.range});
  }
  for (const auto& [name, effect] : arm.effects) {
    const std::string sensor =
        effect.definition->sensor ? arm::to_string(effect.acting_sensor()) : std::string();
    for (const arm::EffectParameter& parameter : effect.definition->parameters) {
      made.push_back({name_of(name, parameter.name), Causality::parameter,
                      effects::unit_of(parameter, sensor), parameter.meaning,
                      effect.value(parameter.name), parameter.range});
    }
  }
  return made;
}

void set_parameter(arm::Arm& arm, const FmuVariable& parameter, double value) {
  arm::require_in_range(parameter.name, value, parameter.unit, *parameter.range);
  if (!parameter.name.starts_with(kEffects)) {
    const auto& keys = arm::arm_keys();
    std::ranges::find(keys, parameter.name, &arm::ArmKey::name)->set(arm, value);
    return;
  }
  for (auto& [name, effect] : arm.effects) {
    for (const arm::EffectParameter& its : effect.definition->parameters) {
      if (name_of(name, its.name) == parameter.name) effect.parameters[its.name] = value;
    }
  }
}

}  // namespace flexarm::fmu
