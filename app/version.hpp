#pragma once

#include <string>
#include <vector>

namespace flexarm::app {

/// A library that the program was built with.
struct LibraryVersion {
  std::string name;
  std::string version;
};

/// Those of numerics, then those of text.
std::vector<LibraryVersion> numeric_libraries();
std::vector<LibraryVersion> text_libraries();

/// "flexarm 0.1.0".
std::string program_version();
/// "Release, GNU 12.2.0, C++20".
std::string build_text();

/// What `flexarm --version` prints: name and version, build, libraries; one a line.
std::string version_text();

}  // namespace flexarm::app
