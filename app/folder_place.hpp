#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::app {

/// What tells a folder that a command wrote from any other.
struct FolderKind {
  std::string what;                  ///< "a measurement"
  std::string marker;                ///< a file that such a folder has: "measurement.toml"
  std::vector<std::string> endings;  ///< of all of its files
};

/// The folder of `simulate` and `import`.
FolderKind measurement_folder_kind();

/// Throws arm::InputError where a command must not write into `folder`: something is there already
/// and `force` is not set, or what is there is not of the kind.
void require_place(const std::string& folder, bool force, const FolderKind& kind);

/// Throws arm::InputError where a `--json` file could not be written once `folder`, which may not
/// be there yet, is: before the work, not after it.
void require_json_place(const std::string& json_file, const std::string& folder);

/// Throws arm::InputError, which begins with `option`, for a file to be written that is one of
/// `inputs`.
void require_no_input(const std::string& option, const std::filesystem::path& file,
                      const std::vector<std::filesystem::path>& inputs);

}  // namespace flexarm::app
