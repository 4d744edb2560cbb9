#pragma once

#include "effects/registry/entry.hpp"

#include <vector>

namespace flexarm::effects {

/// What the function of each file effects/NAME.cpp returns; effects/CMakeLists.txt writes it.
std::vector<Entry> every_effect();

}  // namespace flexarm::effects
