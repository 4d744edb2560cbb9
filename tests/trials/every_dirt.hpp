#pragma once

#include "tests/trials/dirt.hpp"

#include <vector>

namespace flexarm::trials {

/// What the function of each file dirt/NAME.cpp returns; CMakeLists.txt writes it.
std::vector<Dirt> every_dirt();

}  // namespace flexarm::trials
