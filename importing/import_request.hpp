#pragma once

#include "importing/import_runs.hpp"
#include "importing/imported_file.hpp"
#include "importing/joined_files.hpp"

#include <functional>
#include <string>
#include <vector>

namespace flexarm::importing {

/// Log files and what a user says of them, as typed.
struct ImportRequest {
  std::vector<std::string> files;
  FileChoice file;
  JoinChoice join;
  std::string kind;        ///< time, frf or modal; empty: what the file holds
  std::string controller;  ///< KEY=VALUE,... or a TOML file; empty: open loop
  RunsChoice runs;
};

/// The files as they were read, and the runs made of them.
struct Import {
  std::vector<ImportedFile> files;
  std::vector<ImportedRun> runs;
};

/// Throws InputError for choices that cannot be read or do not go together; opens no log.
void require_valid(const ImportRequest& request);

/// Reads the files, one by one or joined, and makes their runs; `read_one` is told of each file
/// that was read. Throws InputError as `require_valid`, `import_file`, `import_joined`, `runs_of`
/// and `set_purposes`; errors name choices as the command line does.
Import import_logs(const ImportRequest& request, const std::function<void()>& read_one);

}  // namespace flexarm::importing
