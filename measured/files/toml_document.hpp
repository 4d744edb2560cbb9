#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace flexarm::measured {

/// Parses TOML. Throws InputError `FILE:LINE: not TOML: what is wrong; what to write instead; the
/// line reads ...`, with advice on the slips that are common in files of numbers, and for keys that
/// are deeper than `kDeepestToml`.
toml::table parse_toml(std::string_view text, const std::string& file_name);

}  // namespace flexarm::measured
