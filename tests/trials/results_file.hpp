#pragma once

#include "tests/trials/score.hpp"

#include <filesystem>
#include <vector>

namespace flexarm::trials {

/// Results as CSV, a line a trial; several names in a cell are joined by "+".
///
/// Reads what an earlier run left; nothing where there is no file. Throws std::runtime_error for a
/// header or a line that is none of ours.
std::vector<TrialResult> read_results(const std::filesystem::path& file);

/// Appends one line, below a header in a new file.
void append_result(const TrialResult& result, const std::filesystem::path& file);

}  // namespace flexarm::trials
