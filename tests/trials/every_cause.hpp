#pragma once

#include "tests/trials/cause.hpp"

#include <vector>

namespace flexarm::trials {

/// What the function of each file causes/NAME.cpp returns; CMakeLists.txt writes it.
std::vector<Cause> every_cause();

}  // namespace flexarm::trials
