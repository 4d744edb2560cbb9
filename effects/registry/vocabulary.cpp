#include "effects/registry/vocabulary.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/every_effect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace flexarm::effects {

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> made = every_effect();
    std::ranges::sort(made, {}, [](const Entry& entry) {
      return std::tuple(entry.definition->ports().front(), entry.definition->name);
    });
    return made;
  }();
  return all;
}

const arm::Vocabulary& vocabulary() {
  static const arm::Vocabulary all = [] {
    arm::Vocabulary made;
    for (const Entry& entry : entries()) made.push_back(entry.definition);
    return made;
  }();
  return all;
}

const Entry* find(std::string_view name) {
  const auto found = std::ranges::find_if(
      entries(), [&](const Entry& entry) { return entry.definition->name == name; });
  return found == entries().end() ? nullptr : &*found;
}

arm::Effect effect(std::string_view name, std::map<std::string, double> parameters,
                   std::string sensor) {
  const auto definition = arm::find_effect(vocabulary(), name);
  if (definition == nullptr) {
    throw arm::InputError(
        fmt::format("{}: {}", arm::shown(name), arm::unknown_effect(vocabulary(), name)));
  }
  return {definition, std::move(parameters), std::move(sensor)};
}

arm::Effect example(const arm::Vocabulary::value_type& definition) {
  arm::Effect made{.definition = definition};
  for (const auto& parameter : definition->parameters) {
    made.parameters[parameter.name] = parameter.example;
  }
  return made;
}

arm::Effects::value_type named(const std::string& name, std::map<std::string, double> parameters,
                               std::string sensor) {
  return {name, effect(name, std::move(parameters), std::move(sensor))};
}

std::string unit_of(const arm::EffectParameter& parameter, const std::string& sensor) {
  const bool is_sensors = parameter.unit == kSensorUnit && !sensor.empty();
  return is_sensors ? std::string(arm::unit(arm::parse_sensor(sensor))) : parameter.unit;
}

void put(arm::Arm& arm, const std::string& name, const std::map<std::string, double>& parameters,
         const std::string& sensor) {
  arm::Effect made = effect(name, parameters, sensor);
  if (const auto found = arm.effects.find(name); found != arm.effects.end()) {
    made.parameters.insert(found->second.parameters.begin(), found->second.parameters.end());
    if (sensor.empty()) made.sensor = found->second.sensor;
  }
  arm.effects[name] = std::move(made);
}

}  // namespace flexarm::effects
