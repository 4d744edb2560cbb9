#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace flexarm::measured {

/// Keys within keys and arrays within arrays of a TOML document that are read: what is read is
/// freed level by level, and a stack ends.
inline constexpr std::size_t kDeepestToml = 256;

/// The first line on which keys and brackets are deeper than `kDeepestToml`, before the document is
/// parsed. Each point outside of texts counts as one of a key, that of a number too.
std::optional<int> line_too_deep(std::string_view toml);

}  // namespace flexarm::measured
