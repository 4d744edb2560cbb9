#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// Writes `content` to `path` so that the file is afterwards the old one or the new one, never a
/// part: into a temporary file of the same folder, synchronised to disk, then renamed. SIGINT,
/// SIGTERM and SIGHUP are held off meanwhile and take effect afterwards. The mode of an existing
/// file is kept; a symbolic link is followed; a device or a pipe is written to directly.
///
/// Throws InputError "PATH: cannot be written: reason"; no temporary file is left then.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Throws what `write_atomically` would throw, as far as that is known before there is something to
/// write: for use in front of work that takes time.
void require_writable(const std::filesystem::path& path);

/// A file of a folder.
struct NamedContent {
  std::string name;  ///< "roots.csv", or in a folder of the folder "payload-0kg/roots.csv"
  std::string content;
};

/// What becomes of a folder that stands in the place of a new one.
enum class IfExists { refuse, replace };

/// What stands in the place of a folder at one time: nothing, or one folder among all that have had
/// its name.
struct FolderSeen {
  bool exists = false;
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::int64_t born_ns = 0;  ///< an inode's number is used again; 0 where it is not kept

  bool operator==(const FolderSeen&) const = default;
};

/// What stands at `path` now. Follows symbolic links.
FolderSeen folder_seen(const std::filesystem::path& path);

/// Writes a folder of files so that it is afterwards there with all of them, or not at all: filled
/// under another name beside it, synchronised to disk, then renamed; folders above are made.
/// Signals are held off as by `write_atomically`. An empty folder of that name is replaced; one
/// with files in it, with everything in it, only where `if_exists` says so, and only if it is the
/// one of `seen`: of two writers that began with the same folder the second is refused, whichever
/// it is, and what the first has written stays whole.
///
/// Throws InputError "PATH: cannot be written: reason"; nothing is left then.
void write_folder_atomically(const std::filesystem::path& path, std::span<const NamedContent> files,
                             IfExists if_exists, const std::optional<FolderSeen>& seen = {});

/// Throws what `write_folder_atomically` would throw for what stands in the folder's place.
void require_new_folder(const std::filesystem::path& path);

/// Makes the folder and those above it; does nothing when it is there.
/// Throws InputError "PATH: cannot be made: reason".
void make_folder(const std::filesystem::path& path);

}  // namespace flexarm::measured
