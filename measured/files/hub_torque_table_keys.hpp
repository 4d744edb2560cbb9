#pragma once

#include "arm/effects.hpp"
#include "arm/hub_torque_table.hpp"
#include "measured/files/stated_effect.hpp"

#include <toml++/toml.h>

#include <memory>
#include <string>

namespace flexarm::measured {

/// Reads `[effects.measured_hub_torque]`. Whatever is wrong goes to `fault` with its line; null is
/// returned then.
std::shared_ptr<const arm::EffectDefinition> read_hub_torque_table(const toml::table& table,
                                                                   const FaultAtLine& fault);

/// The table that reads back the same, every double bit for bit.
std::string format_hub_torque_table(const arm::HubTorqueTable& table);

}  // namespace flexarm::measured
