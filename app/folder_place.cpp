#include "app/folder_place.hpp"

#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// A folder that --force may replace holds the marker, and nothing that such a folder does not.
void require_replaceable(const fs::path& folder, const FolderKind& kind) {
  std::error_code error;
  if (!fs::is_directory(folder, error) || fs::is_empty(folder, error)) return;
  if (!fs::exists(folder / kind.marker, error)) {
    throw arm::InputError(fmt::format("{}: contains no {}; not overwritten by --force",
                                      arm::shown(folder.string()), kind.marker));
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_ours = std::ranges::count(kind.endings, entry.path().extension().string()) > 0;
    if (entry.is_regular_file() && is_ours) continue;
    throw arm::InputError(fmt::format("{}: not part of {}; folder not overwritten by --force",
                                      arm::shown(entry.path().string()), kind.what));
  }
}

}  // namespace

FolderKind measurement_folder_kind() {
  return {"a measurement", "measurement.toml", {".toml", ".csv", ".svg", ".json"}};
}

void require_place(const std::string& folder, bool force, const FolderKind& kind) {
  if (force) {
    require_replaceable(folder, kind);
    return;
  }
  try {
    measured::require_new_folder(folder);
  } catch (const arm::InputError& error) {
    throw arm::InputError(fmt::format("{}; --force replaces {}", error.what(), kind.what));
  }
}

void require_json_place(const std::string& json_file, const std::string& folder) {
  if (json_file.empty()) return;
  const bool in_folder = !folder.empty() && fs::weakly_canonical(json_file).parent_path() ==
                                                fs::weakly_canonical(folder);
  if (!in_folder) measured::require_writable(json_file);
}

void require_no_input(const std::string& option, const fs::path& file,
                      const std::vector<fs::path>& inputs) {
  const fs::path written = fs::weakly_canonical(file);
  for (const fs::path& input : inputs) {
    if (fs::weakly_canonical(input) == written) {
      throw arm::InputError(option + ": file of the measurement");
    }
  }
}

}  // namespace flexarm::app
