#pragma once

#include "arm/effects.hpp"
#include "arm/hub_torque_formula.hpp"

#include <toml++/toml.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace flexarm::measured {

/// Takes a fault of a file and its line.
using FaultAtLine = std::function<void(int line, const std::string& what)>;

/// The key of an arm file's effect that makes it a law of the user's own.
inline constexpr const char* kStatedLawKey = "hub_torque";

/// A law of hub torque that an arm file states: `[effects.NAME]`, its formula and numbers.
struct StatedEffect {
  std::shared_ptr<const arm::EffectDefinition> definition;
  std::map<std::string, double> values;         ///< of the numbers that have one
  std::map<std::string, arm::Interval> ranges;  ///< of those that are to be found
};

/// Reads the table of such a law. Whatever is wrong goes to `fault` with its line; nothing is
/// returned then.
std::optional<StatedEffect> read_stated_effect(const std::string& name, const toml::table& table,
                                               const FaultAtLine& fault);

/// The table that reads back the same; a number has a value, a range or both.
std::string format_stated_effect(const std::string& name, const arm::HubTorqueFormula& formula,
                                 const std::map<std::string, double>& values,
                                 const std::map<std::string, arm::Interval>& ranges);

}  // namespace flexarm::measured
