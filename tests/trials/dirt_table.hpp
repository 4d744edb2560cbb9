#pragma once

#include "tests/trials/scorecard_parts.hpp"

#include <string>

namespace flexarm::trials {

/// A line a kind of dirt: what is named where nothing, one effect, three effects or a cause outside
/// the library is hidden, and whether the dirt is named.
std::string dirt_table(const Results& results);

}  // namespace flexarm::trials
