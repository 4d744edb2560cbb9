#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace flexarm::arm {

/// How whoever asks spells the name of an option in an error: "--max-causes" on a command line,
/// "max_causes" in Python. Options are named in one way where they are read: "max-causes".
using OptionSpelling = std::function<std::string(std::string_view name)>;

/// "--max-causes".
inline std::string on_command_line(std::string_view name) {
  return "--" + std::string(name);
}

}  // namespace flexarm::arm
