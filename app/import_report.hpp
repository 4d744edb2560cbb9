#pragma once

#include "importing/import_runs.hpp"
#include "importing/imported_file.hpp"

#include <string>
#include <vector>

namespace flexarm::app {

/// What the files were read as, and the runs made of them, for the terminal.
std::string import_text(const std::vector<importing::ImportedFile>& files,
                        const std::vector<importing::ImportedRun>& runs);

/// The same as flexarm.import/2 (docs/json.md).
std::string import_json(const std::vector<importing::ImportedFile>& files,
                        const std::vector<importing::ImportedRun>& runs);

}  // namespace flexarm::app
