#pragma once

#include "compare/identification.hpp"
#include "measured/identification.hpp"

#include <filesystem>
#include <vector>

namespace flexarm::app {

/// Writes what was identified into `folder`, which is there: a modal table of each fit and of each
/// run's circles and responses in the order of the analytical roots, each `time` run's response as
/// a frequency record, tables as CSV, and figures. Throws InputError where a file cannot be
/// written.
void write_identified_files(const std::filesystem::path& folder,
                            const measured::Identification& identification,
                            const std::vector<compare::IdentifiedCondition>& conditions);

}  // namespace flexarm::app
