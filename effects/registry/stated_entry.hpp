#pragma once

#include "arm/hub_torque_formula.hpp"
#include "effects/registry/entry.hpp"

#include <string>

namespace flexarm::effects {

/// A law of hub torque that an arm file states, as an effect to be looked for: its ranges are
/// those of the file. A range above 0 is searched in equal ratios, any other in equal steps; where
/// the law vanishes with a number, 0 is where it does nothing.
///
/// Throws InputError as arm::define_effect.
Entry stated_entry(const std::string& name, const arm::HubTorqueHypothesis& stated);

}  // namespace flexarm::effects
