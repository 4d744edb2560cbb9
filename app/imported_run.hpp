#pragma once

#include "app/column_choice.hpp"
#include "measured/files/foreign_file.hpp"
#include "measured/files/run_data.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flexarm::app {

/// What a foreign file was read as, and how.
struct ImportedRun {
  measured::ForeignFormat format = measured::ForeignFormat::text;
  measured::RunKind kind = measured::RunKind::time;
  measured::RunData data;
  measured::ColumnMappings columns;      ///< that were used
  std::vector<std::string> assumptions;  ///< a sentence each
  std::vector<std::string> not_used;     ///< columns and what else the file holds
};

/// Reads a file as a run. The kind is that of what the file holds unless given; `period_s` makes
/// the times of a file without any.
///
/// Throws InputError with one line: as the readers do, for a file of two kinds, and, with the
/// columns found, where time or torque cannot be told.
ImportedRun import_run(const std::string& file, std::optional<measured::RunKind> kind,
                       const ColumnChoice& columns, std::optional<double> period_s);

}  // namespace flexarm::app
