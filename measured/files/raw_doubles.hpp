#pragma once

#include "measured/files/foreign_table.hpp"

#include <cstddef>
#include <filesystem>

namespace flexarm::measured {

/// A file of nothing but doubles (IEEE 754 binary64, little endian), row by row, `columns` in each:
/// columns named "column 1", "column 2", ... without units.
///
/// Throws InputError `FILE: ...` for a file that cannot be read, holds no two rows, or whose size
/// is no multiple of a row's, and for columns fewer than 2.
ForeignTable read_raw_doubles(const std::filesystem::path& path, std::size_t columns);

}  // namespace flexarm::measured
