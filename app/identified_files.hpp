#pragma once

#include "app/folder_place.hpp"
#include "compare/identification.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/figures/figure_files.hpp"
#include "measured/run_identification.hpp"

#include <string>
#include <vector>

namespace flexarm::app {

/// The file that tells a folder of `identify` from others: what `--json` writes.
inline constexpr const char* kIdentifiedJson = "identified.json";

/// The folder of `identify`.
FolderKind identified_folder_kind();

/// What was identified as files: a modal table of each method and run, or runs of a fit, in the
/// order of the analytical roots; each `time` run's response as a frequency record; tables as CSV;
/// figures with `options`. Characters that do not belong in a file's name are '_'; no two have one name.
std::vector<measured::NamedContent> identified_files(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions,
    const report::FigureOptions& options);

}  // namespace flexarm::app
