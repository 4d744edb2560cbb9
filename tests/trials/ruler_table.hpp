#pragma once

#include "tests/trials/scorecard_parts.hpp"

#include <string>

namespace flexarm::trials {

/// The arm of the trial is the steel ruler, which is never drawn by chance.
bool is_ruler(const TrialResult& one);

/// A line a wrong number: how often it, or its class, is named within two standard errors, and how
/// often a crack is.
std::string ruler_table(const Results& ruler);

}  // namespace flexarm::trials
