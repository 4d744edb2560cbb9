#include "app/starter_arm.hpp"

#include "arm/arm_keys.hpp"
#include "arm/effects.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <vector>

namespace flexarm::app {

namespace {

/// Values for the keys that the starter explains but leaves out; all of them together are an arm.
arm::Arm example_values() {
  arm::Arm example = starter_arm();
  example.beam.shear_modulus_Pa = 2.67e10;
  example.beam.given_flexural_rigidity_N_m2 = 3.6918;
  example.beam.given_linear_density_kg_per_m = 0.16486;
  example.hub.viscous_friction_N_m_s_per_rad = 0.002;
  example.payload.mass_kg = 0.06;
  example.payload.inertia_kg_m2 = 1e-5;
  example.damping.kelvin_voigt_s = 1.2e-4;
  return example;
}

void append_key(std::string& out, const arm::ArmKey& key, const arm::Arm& starter,
                const arm::Arm& example) {
  const auto value = key.get(starter);
  const bool given = key.required || (value && value != key.default_value());
  const std::string line = fmt::format("{}{} = {}", given ? "" : "# ", key.leaf,
                                       measured::toml_number(given ? *value : *key.get(example)));
  const auto otherwise = key.default_value();
  fmt::format_to(std::back_inserter(out), "{:<28} # [{}] {}{}\n", line, key.unit, key.meaning,
                 key.required || !otherwise ? "" : fmt::format("; {} if not given", *otherwise));
}

/// "torque [N m], static_torque [N m]"
std::string keys_of(const arm::EffectDefinition& effect) {
  std::vector<std::string> parameters;
  for (const auto& parameter : effect.parameters) {
    parameters.push_back(fmt::format("{} [{}]{}", parameter.name, parameter.unit,
                                     parameter.otherwise ? ", optional" : ""));
  }
  if (effect.sensor) parameters.emplace_back("sensor, optional");
  return fmt::format("{}", fmt::join(parameters, ", "));
}

std::string effects_text() {
  std::string out =
      "\n# Effects beyond the ideal arm, one table each:\n"
      "#\n"
      "# [effects.coulomb_friction]\n"
      "# torque = 0.012             # [N m]\n"
      "#\n"
      "# A law of hub torque of your own, in theta [rad], omega [rad/s], tau [N m] and t [s]:\n"
      "#\n"
      "# [effects.my_cable]\n"
      "# hub_torque = \"-k*theta^3\"\n"
      "# k = 0.05                   # or { range = [0.001, 10] }, to be found by flexarm diagnose\n"
      "#\n"
      "# Effect library:\n"
      "#\n";
  for (const auto& effect : effects::vocabulary()) {
    out += fmt::format("# {}: {}\n#     {}\n", effect->name, keys_of(*effect), effect->meaning);
  }
  return out;
}

}  // namespace

arm::Arm starter_arm() {
  arm::Arm starter = arm::paper_arm();
  starter.beam.given_flexural_rigidity_N_m2.reset();
  return starter;
}

std::string unfilled_text() {
  const arm::Arm example = example_values();
  std::string out =
      "# Arm file for flexarm, SI units. NOTHING IS FILLED IN YET: no number of the arm is known.\n"
      "# Remove the \"#\" in front of each known key and write its value. Required: beam.length,\n"
      "# hub.inertia; youngs_modulus, width and thickness, or flexural_rigidity; density, width\n"
      "# and thickness, or linear_density. Every other key is optional. The last column has\n"
      "# examples of another arm. Until the required keys are given, the file is refused.\n";
  for (const auto& table : arm::arm_tables()) {
    out += fmt::format("\n[{}]\n", table);
    for (const auto& key : arm::arm_keys()) {
      if (key.table != table) continue;
      fmt::format_to(std::back_inserter(out), "{:<28} # [{}] {}{}; e.g. {}\n",
                     fmt::format("# {} =", key.leaf), key.unit, key.meaning,
                     key.required ? "; required" : "", measured::toml_number(*key.get(example)));
    }
  }
  return out + effects_text();
}

std::string starter_text() {
  const arm::Arm starter = starter_arm();
  const arm::Arm example = example_values();
  std::string out = fmt::format(
      "# Arm file for flexarm, SI units. Commented keys are optional; the values are examples.\n"
      "name = {}\n",
      measured::toml_string(starter.name));
  for (const auto& table : arm::arm_tables()) {
    out += fmt::format("\n[{}]{}\n", table,
                       table == "beam" ? "  # left out: a rigid hub, without payload" : "");
    for (const auto& key : arm::arm_keys()) {
      if (key.table == table) append_key(out, key, starter, example);
    }
  }
  return out + effects_text();
}

}  // namespace flexarm::app
