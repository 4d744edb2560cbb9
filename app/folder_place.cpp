#include "app/folder_place.hpp"

#include "app/json_file.hpp"
#include "arm/input_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <map>
#include <system_error>
#include <unistd.h>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// What stood in the place of a command's folder when it began, by the folder's name.
std::map<std::string, measured::FolderSeen>& places_seen() {
  static std::map<std::string, measured::FolderSeen> seen;
  return seen;
}

bool has_entries(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) && !fs::is_empty(folder, error);
}

bool has_marker(const fs::path& folder, const FolderKind& kind) {
  return std::ranges::any_of(kind.markers,
                             [&](const auto& marker) { return fs::exists(folder / marker); });
}

bool is_payload_folder(const fs::directory_entry& entry, const FolderKind& kind) {
  return kind.has_payload_folders && entry.is_directory() && !entry.is_symlink() &&
         entry.path().filename().string().starts_with("payload-");
}

/// A folder that --force may replace holds a marker, and nothing that such a folder does not.
void require_replaceable(const fs::path& folder, const FolderKind& kind) {
  if (!has_entries(folder)) return;
  const bool has_payloads =
      std::ranges::any_of(fs::directory_iterator(folder),
                          [&](const auto& entry) { return is_payload_folder(entry, kind); });
  if (!has_payloads && !has_marker(folder, kind)) {
    throw arm::InputError(fmt::format("{}: contains no {}; not overwritten by --force",
                                      arm::shown(folder.string()),
                                      fmt::join(kind.markers, " or ")));
  }
  FolderKind of_one_arm = kind;
  of_one_arm.has_payload_folders = false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_payload_folder(entry, kind)) {
      require_replaceable(entry.path(), of_one_arm);
      continue;
    }
    const bool is_ours = std::ranges::count(kind.endings, entry.path().extension().string()) > 0;
    if (entry.is_regular_file() && is_ours) continue;
    throw arm::InputError(fmt::format("{}: not part of {}; folder not overwritten by --force",
                                      arm::shown(entry.path().string()), kind.what));
  }
}

/// Throws where the folder, or those above it that are not there, cannot be made.
void require_makeable(const fs::path& folder) {
  fs::path there = folder.has_filename() ? folder : folder.parent_path();
  std::error_code error;
  while (!there.empty() && !fs::exists(there, error)) there = there.parent_path();
  if (there.empty()) there = ".";
  const int reason = !fs::is_directory(there, error)      ? ENOTDIR
                     : ::access(there.c_str(), W_OK) != 0 ? errno
                                                          : 0;
  if (reason == 0) return;
  throw arm::InputError(fmt::format("{}: cannot be made: {}", arm::shown(folder.string()),
                                    std::generic_category().message(reason)));
}

}  // namespace

FolderKind measurement_folder_kind() {
  return {
      "a measurement", {"measurement.toml"}, {".toml", ".csv", ".svg", ".pdf", ".png", ".json"}};
}

void require_place(const std::string& folder, bool force, const FolderKind& kind) {
  places_seen()[folder] = measured::folder_seen(folder);
  require_makeable(folder);
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

bool is_begun(const std::string& folder, const std::string& file) {
  if (!has_entries(folder)) return false;
  const auto seen = measured::folder_seen(folder);
  const auto entries = fs::directory_iterator(folder);
  const bool begun = std::ranges::all_of(
      entries, [&](const auto& entry) { return entry.path().filename() == fs::path(file); });
  if (begun) places_seen()[folder] = seen;
  return begun;
}

void write_folder(const std::string& folder, bool force,
                  std::span<const measured::NamedContent> files) {
  const auto if_exists = force ? measured::IfExists::replace : measured::IfExists::refuse;
  measured::write_folder_atomically(folder, files, if_exists, places_seen()[folder]);
}

void require_json_place(const std::string& json_file, const std::string& folder) {
  if (json_file.empty() || is_standard_output(json_file)) return;
  const bool in_folder = !folder.empty() && fs::weakly_canonical(json_file).parent_path() ==
                                                fs::weakly_canonical(folder);
  if (!in_folder) measured::require_writable(json_file);
}

}  // namespace flexarm::app
