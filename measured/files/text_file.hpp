#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace flexarm::measured {

/// The whole of a file as bytes, without a leading UTF-8 byte-order mark.
///
/// Throws InputError "FILE: what is wrong": missing (with the file of the folder that was probably
/// meant), a directory, not readable, or larger than `largest_bytes`.
std::string read_text_file(const std::filesystem::path& path, std::size_t largest_bytes);

}  // namespace flexarm::measured
