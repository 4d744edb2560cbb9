#pragma once

#include <string>
#include <string_view>

namespace flexarm::trials {

/// The family of physical causes that an effect states in effects/NAME.cpp; empty for a name that
/// the library does not have. Answers are scored by it; the simulator does not use it.
std::string_view family_of(const std::string& effect);

}  // namespace flexarm::trials
