#pragma once

#include "measured/files/atomic_file.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::app {

/// What tells a folder that a command wrote from any other.
struct FolderKind {
  std::string what;                  ///< "a measurement"
  std::vector<std::string> markers;  ///< such a folder has one of these files
  std::vector<std::string> endings;  ///< of all of its files
  bool has_payload_folders = false;  ///< or, of several arms, a folder payload-... for each
};

/// The folder of `simulate` and `import`.
FolderKind measurement_folder_kind();

/// The rule for the folder of every command: it is written whole or not at all, and one with files
/// in it is replaced only with --force, and only if nothing but files of the kind is in it. It may
/// hold a recording, or results that took hours; what is replaced leaves nothing behind that is not
/// of the new results.
///
/// Throws arm::InputError where a command must not write into `folder`, or could not: before the
/// work, not after it.
void require_place(const std::string& folder, bool force, const FolderKind& kind);

/// Whether the folder has the file, and nothing else: what the command itself has begun there,
/// which `write_folder` may replace.
bool is_begun(const std::string& folder, const std::string& file);

/// Writes the files into the folder by the rule, once `require_place` has been asked. Throws
/// arm::InputError where another process has written files there since: of two commands one writes
/// its folder whole, and the other says so.
void write_folder(const std::string& folder, bool force,
                  std::span<const measured::NamedContent> files);

/// Throws arm::InputError where a `--json` file could not be written once `folder`, which may not
/// be there yet, is: before the work, not after it.
void require_json_place(const std::string& json_file, const std::string& folder);

}  // namespace flexarm::app
