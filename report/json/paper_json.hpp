#pragma once

#include "compare/paper/paper_topics.hpp"

#include <string>

namespace flexarm::report {

/// The text of `flexarm paper --json FILE`, schema flexarm.paper/1 (docs/paper.md).
std::string paper_json(const compare::paper::Findings& findings);

}  // namespace flexarm::report
