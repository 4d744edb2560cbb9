#pragma once

#include "measured/files/file_writing.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// A file in memory, for libraries that read or write files by their name: no folder has to have
/// room for it, and nothing of it is left behind.
class MemoryFile {
 public:
  /// Throws std::system_error where there is no memory for it.
  explicit MemoryFile(std::string_view content = {});

  /// Its name, as long as it exists.
  std::filesystem::path path() const;
  /// What has been written into it by that name. Throws std::system_error.
  std::string content() const;

 private:
  Descriptor descriptor_;
};

}  // namespace flexarm::measured
