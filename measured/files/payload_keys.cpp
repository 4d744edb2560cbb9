#include "measured/files/payload_keys.hpp"

#include "arm/input_error.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>

namespace flexarm::measured {

arm::Payload read_payload(measured::TomlFaults& faults, const toml::node& node) {
  arm::Payload payload;
  const auto* table = node.as_table();
  if (table == nullptr) {
    faults.wrong("run.payload", node, "a table, as in { mass = 0.06, inertia = 0.0 }");
    return payload;
  }
  for (const auto& [name, value] : *table) {
    const std::string leaf = arm::shown(name.str());
    if (leaf == "mass") {
      faults.read_number("run.payload.mass", value, "kg", arm::kNotNegative, payload.mass_kg);
    } else if (leaf == "inertia") {
      faults.read_number("run.payload.inertia", value, "kg m^2", arm::kNotNegative,
                         payload.inertia_kg_m2);
    } else {
      faults.unknown("run.payload.", leaf, value, {"mass", "inertia"});
    }
  }
  return payload;
}

std::string format_payload(const arm::Payload& payload) {
  return fmt::format("{{ mass = {}, inertia = {} }}  # kg, kg m^2 about its centre of mass",
                     measured::toml_number(payload.mass_kg),
                     measured::toml_number(payload.inertia_kg_m2));
}

}  // namespace flexarm::measured
