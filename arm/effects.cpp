#include "arm/effects.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace flexarm::arm {

namespace {

void require_valid_effect(const std::string& key, const Effect& effect) {
  if (effect.definition == nullptr) throw InputError(key + ": has no definition", key);
  const EffectDefinition& definition = *effect.definition;
  if (!effect.sensor.empty() && !definition.sensor) {
    throw InputError(
        fmt::format("{}.sensor: unknown key; {} does not act on one sensor", key, definition.name),
        key + ".sensor");
  }
  for (const auto& [name, value] : effect.parameters) {
    const auto parameter = std::ranges::find(definition.parameters, name, &EffectParameter::name);
    if (parameter == definition.parameters.end()) {
      std::vector<std::string> names;
      for (const auto& known : definition.parameters) names.push_back(known.name);
      if (definition.sensor) names.emplace_back("sensor");
      throw InputError(fmt::format("{}.{}: unknown key{}; allowed: {}", key, name,
                                   did_you_mean(name, names), fmt::join(names, ", ")),
                       key + "." + name);
    }
    require_in_range(key + "." + name, value, parameter->unit, parameter->range);
  }
  for (const auto& parameter : definition.parameters) {
    if (!parameter.otherwise && !effect.parameters.contains(parameter.name)) {
      throw InputError(fmt::format("{}.{}: missing; must be {} [{}]", key, parameter.name,
                                   to_string(parameter.range), parameter.unit),
                       key + "." + parameter.name);
    }
  }
}

}  // namespace

double Effect::value(const std::string& parameter) const {
  if (const auto found = parameters.find(parameter); found != parameters.end()) {
    return found->second;
  }
  return std::ranges::find(definition->parameters, parameter, &EffectParameter::name)
      ->otherwise.value();
}

Sensor Effect::acting_sensor() const {
  return sensor.empty() ? definition->sensor.value() : parse_sensor(sensor);
}

Effect redefined(const Effect& effect, const std::function<void(EffectDefinition&)>& change) {
  EffectDefinition definition = *effect.definition;
  change(definition);
  Effect made = effect;
  made.definition = std::make_shared<const EffectDefinition>(std::move(definition));
  return made;
}

bool Effect::operator==(const Effect& other) const {
  if (parameters != other.parameters || sensor != other.sensor) return false;
  if (definition == other.definition) return true;
  return definition != nullptr && other.definition != nullptr &&
         !std::holds_alternative<std::monostate>(definition->given) &&
         definition->name == other.definition->name && definition->given == other.definition->given;
}

std::vector<Port> EffectDefinition::ports() const {
  std::vector<Port> made;
  if (arm_number) made.push_back(Port::arm_number);
  if (linear_term) made.push_back(Port::linear_term);
  if (sensor_place) made.push_back(Port::sensor_place);
  if (torque_path) made.push_back(Port::torque_path);
  if (hub_torque) made.push_back(Port::hub_torque);
  if (beam_force) made.push_back(Port::beam_force);
  if (sensor_path) made.push_back(Port::sensor_path);
  return made;
}

bool EffectDefinition::is_of_linear_arm() const {
  return !torque_path && !hub_torque && !beam_force && !sensor_path;
}

std::shared_ptr<const EffectDefinition> find_effect(const Vocabulary& vocabulary,
                                                    std::string_view name) {
  const auto entry =
      std::ranges::find_if(vocabulary, [&](const auto& effect) { return effect->name == name; });
  return entry == vocabulary.end() ? nullptr : *entry;
}

std::string unknown_effect(const Vocabulary& vocabulary, std::string_view name) {
  std::vector<std::string> names;
  for (const auto& entry : vocabulary) names.push_back(entry->name);
  return fmt::format("unknown effect{}; allowed: {}", did_you_mean(name, names),
                     fmt::join(names, ", "));
}

void require_valid(const Effects& effects) {
  for (const auto& [name, effect] : effects) require_valid_effect("effects." + name, effect);
}

void require_honoured(const Effects& effects, std::string_view who,
                      std::span<const Port> honoured) {
  for (const auto& [name, effect] : effects) {
    for (const Port port : effect.definition->ports()) {
      if (std::ranges::find(honoured, port) != honoured.end()) continue;
      std::vector<std::string_view> names;
      for (const Port known : honoured) names.push_back(to_string(known));
      throw InputError(fmt::format("effects.{}: not supported by {}, because it acts through the "
                                   "port {}; supported ports: {}",
                                   name, who, to_string(port), fmt::join(names, ", ")),
                       "effects." + name);
    }
  }
}

}  // namespace flexarm::arm
