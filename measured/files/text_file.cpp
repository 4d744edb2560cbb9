#include "measured/files/text_file.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

namespace flexarm::measured {

namespace {

namespace fs = std::filesystem;

arm::InputError unreadable(const fs::path& path, const std::string& reason) {
  return arm::InputError(fmt::format("{}: {}", arm::shown(path.string()), reason));
}

/// Names of the files in `folder`, ascending.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (entry->is_regular_file(ignored)) names.push_back(entry->path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

/// " (did you mean ...?)" with the file of the same folder whose name is nearest.
std::string nearest_file(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const auto name = arm::nearest_name(path.filename().string(), files_in(folder));
  return name
             ? fmt::format(" (did you mean {}?)", arm::shown((path.parent_path() / *name).string()))
             : "";
}

/// ", such as ..." with the TOML files of a folder: its arm, its measurement.
std::string toml_files_in(const fs::path& folder) {
  std::vector<std::string> paths;
  for (const std::string& name : files_in(folder)) {
    if (name.ends_with(".toml")) paths.push_back(arm::shown((folder / name).string()));
  }
  constexpr std::size_t kMostShown = 3;
  if (paths.empty() || paths.size() > kMostShown) return "";
  return fmt::format(", such as {}", fmt::join(paths, " or "));
}

}  // namespace

std::string read_text_file(const fs::path& path, std::size_t largest_bytes) {
  if (path.empty()) throw arm::InputError("the name of a file is empty");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    throw unreadable(path, "no such file" + nearest_file(path));
  }
  if (error) throw unreadable(path, "cannot be read: " + error.message());
  if (fs::is_directory(status)) {
    throw unreadable(path, "is a folder; must be a file" + toml_files_in(path));
  }
  // A pipe may wait for ever, a device may have no end.
  if (!fs::is_regular_file(status)) {
    throw unreadable(path, "is a pipe or a device; must be a regular file");
  }

  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw unreadable(path, "cannot be read: " + std::generic_category().message(errno));
  std::string text;
  std::array<char, 65536> part;
  while (text.size() <= largest_bytes && file) {
    file.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) {
    throw unreadable(path, "cannot be read: " + std::generic_category().message(errno));
  }
  if (text.size() > largest_bytes) {
    throw unreadable(path, fmt::format("too large; at most {} bytes are read", largest_bytes));
  }
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

}  // namespace flexarm::measured
