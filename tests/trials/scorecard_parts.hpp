#pragma once

#include "tests/trials/score.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace flexarm::trials {

using Results = std::vector<TrialResult>;
using Choice = std::function<bool(const TrialResult&)>;

Results chosen(const Results& results, const Choice& choice);
int count(const Results& results, const Choice& choice);
int count(const Results& results, Outcome outcome);

/// The hidden causes are named, or a class of few with them.
bool is_found(const TrialResult& one);
/// So many effects of the library are hidden, and nothing outside of it.
bool has_effects(const TrialResult& one, std::size_t effects);

/// "12/14 (86 %)".
std::string part(int some, int all);
/// The median, the higher of two in the middle; 0 of no values.
double median(std::vector<double> values);
/// Rows of a table in Markdown.
std::string row(const std::string& name, const std::vector<std::string>& cells);
std::string header(const std::string& name, const std::vector<std::string>& cells);

}  // namespace flexarm::trials
