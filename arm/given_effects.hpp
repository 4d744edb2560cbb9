#pragma once

#include "arm/effects.hpp"

#include <map>
#include <memory>
#include <string>

namespace flexarm::arm {

/// The effect of a law of hub torque that an arm file states. Its parameters are the formula's
/// numbers. What is linear of it at rest, a spring and a dashpot of the hub, is a term of the
/// linear arm; the rest is a law of hub torque (arm/formula_law.hpp).
///
/// `typical` has a value for each number, at which the law is checked. Throws InputError, with the
/// key `effects.NAME.hub_torque` or `effects.NAME.NUMBER`, as CompiledFormula and
/// FormulaLaw::require_law do.
std::shared_ptr<const EffectDefinition> define_effect(const std::string& name,
                                                      const HubTorqueFormula& formula,
                                                      const std::map<std::string, double>& typical);

/// The effect `measured_hub_torque` of a table, without parameters. Throws InputError as
/// require_valid(HubTorqueTable).
std::shared_ptr<const EffectDefinition> define_effect(const HubTorqueTable& table);

/// What stands for the unit of a number that the arm file gives none.
inline constexpr const char* kUnitNotGiven = "SI";

}  // namespace flexarm::arm
