#pragma once

#include <filesystem>
#include <string_view>

namespace flexarm::fuzz {

/// Where a reader that takes a path finds the bytes: a file in memory, made once and rewritten for
/// each input. Throws std::system_error where the system has none.
std::filesystem::path file_with(std::string_view bytes);

}  // namespace flexarm::fuzz
