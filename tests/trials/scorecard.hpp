#pragma once

#include "tests/trials/score.hpp"

#include <string>
#include <vector>

namespace flexarm::trials {

/// The results as a page of Markdown: per kind of data and noise what was named, what was not, and
/// how well; the confusion of causes; the weakest strength found; every failure.
std::string scorecard(const std::vector<TrialResult>& results);

}  // namespace flexarm::trials
