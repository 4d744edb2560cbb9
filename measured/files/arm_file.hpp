#pragma once

#include "arm/arm.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// The largest arm file that is read.
inline constexpr std::size_t kLargestArmFile_bytes = std::size_t{1} << 20U;

/// Reads an arm file (TOML, docs/formats.md) whose effects are among `vocabulary`.
///
/// Throws InputError with one line `FILE:LINE: KEY = VALUE UNIT: what is wrong; what is allowed`:
/// for a file that cannot be read or is not TOML, an unknown key (with the name that was probably
/// meant), a value of the wrong type or out of its range, a missing key, and an arm that
/// `require_valid` refuses. Of several keys that are wrong in themselves, the first in the file is
/// reported; what is missing or does not fit together comes after those.
arm::Arm read_arm_file(const std::filesystem::path& path, const arm::Vocabulary& vocabulary);

/// The same for the text of a file; `file_name` stands in the errors.
arm::Arm parse_arm(std::string_view toml, const std::string& file_name,
                   const arm::Vocabulary& vocabulary);

/// Whether no number of the arm is filled in, as in the template of `flexarm import`. Throws
/// InputError for a file that cannot be read or is not TOML.
bool is_unfilled_arm_file(const std::filesystem::path& path);

/// The arm as the text of a file: what it gives, with units as comments; values equal to their
/// default are left out. `parse_arm` reads the same arm back, every double bit for bit.
/// Throws InputError for an arm that is not valid, or whose name is not UTF-8.
std::string format_arm(const arm::Arm& arm);

/// `format_arm` written to `path`, whole or not at all (measured/files/atomic_file.hpp).
void write_arm_file(const arm::Arm& arm, const std::filesystem::path& path);

/// A double in TOML: the shortest decimal that reads back to the same double, always a float.
std::string toml_number(double value);

/// A TOML basic string, quoted and escaped. `text` must be UTF-8.
std::string toml_string(std::string_view text);

}  // namespace flexarm::measured
