#pragma once

#include "tests/trials/score.hpp"

#include <string>
#include <vector>

namespace flexarm::trials {

/// Of a program that nobody says the version of.
inline constexpr const char* kUnknownVersion = "an unknown version";

/// Throws arm::InputError for a result of another version of the program.
void require_one_version(const std::vector<TrialResult>& results, const std::string& version);

/// The results as a page of Markdown: the version of the program; per kind of data and noise what
/// was named, what was not, and how well; the confusion of causes; how reliable probabilities and
/// intervals are; the weakest strength found; every failure. Throws arm::InputError for results of
/// several versions.
std::string scorecard(const std::vector<TrialResult>& results);

}  // namespace flexarm::trials
