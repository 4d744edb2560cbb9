#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flexarm::arm {

/// The name among `names` that `typed` was probably meant to be: the nearest by insertions,
/// deletions, substitutions and swaps of neighbours, at most a third of the longer word; else the
/// only one that has it for a first or last word ("coulomb", "coulomb_friction"). Empty when none
/// is near.
std::optional<std::string> nearest_name(std::string_view typed, std::span<const std::string> names);

/// " (did you mean NAME?)", or "" when no name is near.
std::string did_you_mean(std::string_view typed, std::span<const std::string> names);

}  // namespace flexarm::arm
