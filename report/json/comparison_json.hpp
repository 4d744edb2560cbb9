#pragma once

#include "compare/comparison.hpp"
#include "compare/measured_responses.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// A comparison and the measurement beside it.
struct ComparedArm {
  compare::Comparison comparison;
  compare::MeasuredComparison measured = {};
};

/// The arms compared as a JSON document of schema `flexarm.compare/1` (docs/json.md).
std::string comparison_json(const std::vector<ComparedArm>& arms);

}  // namespace flexarm::report
