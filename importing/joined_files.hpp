#pragma once

#include "importing/imported_file.hpp"
#include "measured/files/joined_table.hpp"

#include <string>
#include <vector>

namespace flexarm::importing {

/// Whether files are one run, and on which times; as typed.
struct JoinChoice {
  bool is_wanted = false;
  std::string grid = "same";
};

/// Reads files that each hold some of the signals of one run, and joins them by time
/// (measured/files/joined_table.hpp). Each has times of its own, by name or by `--column
/// time=NAME`; the other columns are taken for quantities together.
///
/// Throws InputError as `read_file` and `import_file` do, for less than two files, one without
/// times or with times that do not increase, and files that cannot be joined.
ImportedFile import_joined(const std::vector<std::string>& files, const FileChoice& choice,
                           const JoinChoice& join, measured::TorqueHold hold);

}  // namespace flexarm::importing
