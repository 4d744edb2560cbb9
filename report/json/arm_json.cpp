#include "report/json/arm_json.hpp"

#include "arm/effects.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/vocabulary.hpp"

#include <variant>

namespace flexarm::report {

namespace {

nlohmann::ordered_json effects_json(const arm::Effects& effects) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const auto& [name, effect] : effects) {
    nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
    for (const auto& parameter : effect.definition->parameters) {
      const auto value = effect.parameters.find(parameter.name);
      if (value == effect.parameters.end()) continue;
      parameters.push_back(
          {{"name", parameter.name},
           {"value", value->second},
           {"unit", effects::unit_of(parameter, effect.definition->sensor
                                                    ? arm::to_string(effect.acting_sensor())
                                                    : std::string())}});
    }
    nlohmann::ordered_json entry = {
        {"effect", name}, {"parameters", parameters}, {"sensor", nullptr}, {"hub_torque", nullptr}};
    if (!effect.sensor.empty()) entry["sensor"] = effect.sensor;
    if (const auto* formula = std::get_if<arm::HubTorqueFormula>(&effect.definition->given)) {
      entry["hub_torque"] = formula->text;
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace

nlohmann::ordered_json arm_json(const arm::Arm& arm) {
  const auto of_beam = [&arm](auto number) {
    return number_json(arm::has_beam(arm) ? std::optional<double>(number()) : std::nullopt);
  };
  return {
      {"name", arm.name},
      {"length_m", of_beam([&] { return arm.beam.length_m; })},
      {"flexural_rigidity_N_m2", of_beam([&] { return arm.beam.flexural_rigidity_N_m2(); })},
      {"linear_density_kg_per_m", of_beam([&] { return arm.beam.linear_density_kg_per_m(); })},
      {"hub_inertia_kg_m2", arm.hub.inertia_kg_m2},
      {"hub_viscous_friction_N_m_s_per_rad", arm.hub.viscous_friction_N_m_s_per_rad},
      {"payload_mass_kg", arm.payload.mass_kg},
      {"payload_inertia_kg_m2", arm.payload.inertia_kg_m2},
      {"kelvin_voigt_s", arm.damping.kelvin_voigt_s},
      {"total_inertia_kg_m2", arm::total_inertia_kg_m2(arm)},
      {"hub_inertia_ratio", of_beam([&] { return arm::hub_inertia_ratio(arm); })},
      {"payload_mass_ratio", of_beam([&] { return arm::payload_mass_ratio(arm); })},
      {"payload_inertia_ratio", of_beam([&] { return arm::payload_inertia_ratio(arm); })},
      {"effects", effects_json(arm.effects)},
  };
}

nlohmann::ordered_json number_json(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json complex_json(const std::optional<std::complex<double>>& value) {
  if (!value) return nullptr;
  return {{"re", value->real()}, {"im", value->imag()}};
}

}  // namespace flexarm::report
