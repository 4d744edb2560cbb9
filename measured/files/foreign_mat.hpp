#pragma once

#include "measured/files/foreign_file.hpp"

#include <filesystem>

namespace flexarm::measured {

/// A MATLAB file as signals and frequency responses, as `read_foreign_file` says. Throws
/// InputError `FILE: what is wrong` as `read_mat_contents` does, and for a file with the schema of
/// a record that holds none.
ForeignFile mat_contents(const std::filesystem::path& path);

}  // namespace flexarm::measured
