#include "app/starter_arm.hpp"

#include "arm/arm_keys.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>

#include <iterator>

namespace flexarm::app {

namespace {

/// Values for the keys that the starter explains but leaves out; all of them together are an arm.
arm::Arm example_values() {
  arm::Arm example = starter_arm("");
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

constexpr const char* kEffectsText =
    "\n# Friction, a soft clamp, a late torque and the like are effects, a table each:\n"
    "#\n"
    "# [effects.coulomb_friction]\n"
    "# torque = 0.012             # [N m]\n"
    "#\n"
    "# flexarm effects lists them, flexarm effects coulomb_friction describes one.\n";

}  // namespace

arm::Arm starter_arm(const std::string& name) {
  arm::Arm starter = arm::paper_arm();
  starter.name = name;
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
  return out + kEffectsText;
}

std::string starter_text(const std::string& name) {
  const arm::Arm starter = starter_arm(name);
  const arm::Arm example = example_values();
  std::string out = fmt::format(
      "# Arm file for flexarm, SI units. The values are those of an aluminium link of 0.96 m:\n"
      "# write your own. Keys behind a \"#\" are optional.\n"
      "name = {}\n",
      measured::toml_string(starter.name));
  for (const auto& table : arm::arm_tables()) {
    out += fmt::format("\n[{}]{}\n", table,
                       table == "beam" ? "  # left out: a rigid hub, without payload" : "");
    for (const auto& key : arm::arm_keys()) {
      if (key.table == table) append_key(out, key, starter, example);
    }
  }
  return out + kEffectsText;
}

}  // namespace flexarm::app
