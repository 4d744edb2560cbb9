#pragma once

#include "compare/comparison.hpp"
#include "compare/measured.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// A comparison and the measurement beside it.
struct ComparedArm {
  compare::Comparison comparison;
  std::vector<compare::MeasuredRow> measured;
};

/// The arms compared as a JSON document of schema `flexarm.compare/1` (docs/json.md).
std::string comparison_json(const std::vector<ComparedArm>& arms);

}  // namespace flexarm::report
