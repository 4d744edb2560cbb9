#include "measured/files/atomic_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/file_writing.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace flexarm::measured {

namespace {

namespace fs = std::filesystem;

arm::InputError not_written(const fs::path& path, const std::string& reason) {
  return arm::InputError(
      fmt::format("{}: cannot be written: {}", arm::shown(path.string()), reason));
}

/// A device, a pipe or a terminal: there is nothing to replace.
void write_directly(const fs::path& path, std::string_view content) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  int error = file.is_open() ? write_all(file.get(), content) : errno;
  if (error == 0) error = file.close();
  if (error != 0) throw not_written(path, reason_of(error));
}

/// The file that `path` leads to by symbolic links.
fs::path target_of(const fs::path& path) {
  std::error_code ignored;
  return fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
}

/// The handlers of signals belong to the whole program.
std::mutex& one_writer_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

/// A file or folder of a random name, and how making it ended.
struct Temporary {
  fs::path path;
  int error = 0;  ///< 0, or the errno of the step that failed
};

/// Makes what `make(path)` makes under a name in `folder` that is not taken; what has been made is
/// there, whole or in part.
template <class Make>
Temporary make_temporary(const fs::path& folder, const Make& make) {
  sweep_temporaries(folder);
  Temporary made;
  for (int i = 0; i < kMostNames; ++i) {
    made.path = temporary_name(folder);
    made.error = make(made.path);
    if (made.error != EEXIST) break;
  }
  return made;
}

/// Fills the folder; 0, or the errno of the step that failed.
int fill_folder(const fs::path& temporary, std::span<const NamedContent> files) {
  for (const auto& file : files) {
    const fs::path within = temporary / fs::path(file.name).parent_path();
    if (::mkdir(within.c_str(), 0777) != 0 && errno != EEXIST) return errno;
    if (const int error = create_file(temporary / file.name, file.content); error != 0) {
      return error;
    }
  }
  for (const auto& entry : fs::directory_iterator(temporary)) {
    if (entry.is_directory()) synchronise_folder(entry.path());
  }
  synchronise_folder(temporary);
  return 0;
}

/// Puts `temporary` in the place of `folder`, and what was there in the place of `temporary`.
int exchange_folders(const fs::path& temporary, const fs::path& folder) {
  if (::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) {
    return 0;
  }
  // A file system that cannot exchange: for a moment neither stands there, but both are whole.
  const fs::path aside = temporary_name(folder_of(folder));
  if (::rename(folder.c_str(), aside.c_str()) != 0) return errno;
  if (::rename(temporary.c_str(), folder.c_str()) != 0) {
    const int error = errno;
    std::rename(aside.c_str(), folder.c_str());
    return error;
  }
  return ::rename(aside.c_str(), temporary.c_str()) == 0 ? 0 : errno;
}

/// "rig/" as "rig": the folder itself, not what is in it.
fs::path without_slash(const fs::path& path) {
  return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

}  // namespace

void require_writable(const fs::path& path) {
  if (path.empty()) throw arm::InputError("the name of a file is empty");
  struct stat status = {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) throw not_written(path, reason_of(errno));
  if (exists && S_ISDIR(status.st_mode)) throw not_written(path, "is a folder");
  if (!path.has_filename()) throw not_written(path, "names no file");
  // A rename asks only the folder for permission; a file that is read-only is meant to stay.
  if (exists && ::access(path.c_str(), W_OK) != 0) throw not_written(path, reason_of(errno));
  const fs::path folder = folder_of(target_of(path));
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw not_written(path, fmt::format("there is no folder {}", arm::shown(folder.string())));
  }
}

void write_atomically(const fs::path& path, std::string_view content) {
  const std::scoped_lock lock(one_writer_at_a_time());
  require_writable(path);
  struct stat status = {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && !S_ISREG(status.st_mode)) return write_directly(path, content);

  const fs::path target = target_of(path);
  const fs::path folder = folder_of(target);

  const SignalsHeldOff held_off;
  auto [temporary, error] = make_temporary(folder, [&](const fs::path& name) {
    return create_file(name, content, exists ? &status : nullptr);
  });
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    if (error != EEXIST) ::unlink(temporary.c_str());
    throw not_written(path, reason_of(error));
  }
  synchronise_folder(folder);
}

namespace {

arm::InputError written_by_another(const fs::path& path) {
  return not_written(path, "another process has written files there meanwhile");
}

/// Whether a folder with files in it stands there.
bool has_files(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return false;
  if (error) throw not_written(path, error.message());
  if (!fs::is_directory(status)) throw not_written(path, "is no folder");
  const bool is_empty = fs::is_empty(path, error);
  if (error) throw not_written(path, error.message());
  return !is_empty;
}

}  // namespace

void require_new_folder(const fs::path& path) {
  if (has_files(path)) throw not_written(path, "is a folder with files in it");
}

namespace {

/// Throws where `folder`, which the user calls `path`, must not be written.
void require_place_of(const fs::path& folder, const fs::path& path, IfExists if_exists,
                      const std::optional<FolderSeen>& seen) {
  const bool is_full = has_files(folder);
  if (is_full && seen && folder_seen(folder) != *seen) throw written_by_another(path);
  if (is_full && if_exists == IfExists::refuse) require_new_folder(folder);
}

/// While one lives, no other process that has one puts a folder into `parent`. A file system
/// without such locks is written to all the same.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& parent)
      : descriptor_(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_.is_open()) ::flock(descriptor_.get(), LOCK_EX);
  }

 private:
  Descriptor descriptor_;
};

}  // namespace

FolderSeen folder_seen(const fs::path& path) {
  struct statx status = {};
  if (::statx(AT_FDCWD, path.c_str(), 0, STATX_INO | STATX_BTIME, &status) != 0) return {};
  FolderSeen seen;
  seen.exists = true;
  seen.device = (std::uint64_t{status.stx_dev_major} << 32U) | status.stx_dev_minor;
  seen.inode = status.stx_ino;
  if ((status.stx_mask & STATX_BTIME) != 0) {
    constexpr std::int64_t kNanoseconds = 1'000'000'000;
    seen.born_ns = status.stx_btime.tv_sec * kNanoseconds + status.stx_btime.tv_nsec;
  }
  return seen;
}

void write_folder_atomically(const fs::path& path, std::span<const NamedContent> files,
                             IfExists if_exists, const std::optional<FolderSeen>& seen) {
  const std::scoped_lock lock(one_writer_at_a_time());
  const fs::path folder = target_of(without_slash(path));
  require_place_of(folder, path, if_exists, seen);
  make_folder(folder_of(folder));

  const SignalsHeldOff held_off;
  auto [temporary, error] = make_temporary(folder_of(folder), [](const fs::path& name) {
    return ::mkdir(name.c_str(), 0777) == 0 ? 0 : errno;
  });
  if (error != 0) throw not_written(path, reason_of(error));
  std::error_code ignored;
  try {
    error = fill_folder(temporary, files);
    if (error == 0) {
      const FolderLock others(folder_of(folder));
      require_place_of(folder, path, if_exists, seen);
      error = has_files(folder) ? exchange_folders(temporary, folder)
              : ::rename(temporary.c_str(), folder.c_str()) == 0 ? 0
                                                                 : errno;
    }
  } catch (...) {
    fs::remove_all(temporary, ignored);
    throw;
  }
  fs::remove_all(temporary, ignored);  // what was left of the new folder, or the old one
  if (error == ENOTEMPTY || error == EEXIST) throw written_by_another(path);
  if (error != 0) throw not_written(path, reason_of(error));
  synchronise_folder(folder_of(folder));
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) {
    throw arm::InputError(
        fmt::format("{}: cannot be made: {}", arm::shown(path.string()), error.message()));
  }
}

}  // namespace flexarm::measured
