#pragma once

#include "compare/paper/paper_check.hpp"
#include "compare/paper/paper_models.hpp"

#include <vector>

namespace flexarm::compare::paper {

/// What the paper measured, Tables 2-7, against its own equations; `bare` is the paper's arm.
std::vector<Check> check_measured_tables(const ThreeModels& bare);

}  // namespace flexarm::compare::paper
