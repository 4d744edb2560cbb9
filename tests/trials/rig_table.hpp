#pragma once

#include "tests/trials/scorecard_parts.hpp"

#include <string>

namespace flexarm::trials {

/// Trials of rigs, a line an arm and one for all: leading causes named, wrong names, held-out error
/// over its floor, processor time. All results have `rig`.
std::string rig_table(const Results& rigs);

}  // namespace flexarm::trials
