#pragma once

#include "compare/sweeps/sweep_result.hpp"

#include <string>

namespace flexarm::report {

/// The text of a file of schema `flexarm.sweep/1` (docs/json.md): what was asked, every value by
/// model in the order of the grid, events, agreement.
std::string sweep_json(const compare::SweepResult& result);

}  // namespace flexarm::report
