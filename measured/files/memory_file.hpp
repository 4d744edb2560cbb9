#pragma once

#include "measured/files/file_writing.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// A file in memory, for libraries and programs that read or write files: no folder has to have
/// room for it, and nothing of it is left behind.
class MemoryFile {
 public:
  /// Stands at its beginning. Throws std::system_error where there is no memory for it.
  explicit MemoryFile(std::string_view content = {});

  /// Its name within this process, as long as it exists.
  std::filesystem::path path() const;
  int descriptor() const { return descriptor_.get(); }
  /// What has been written into it, by whomever. Throws std::system_error.
  std::string content() const;

 private:
  Descriptor descriptor_;
};

}  // namespace flexarm::measured
