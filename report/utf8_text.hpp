#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace flexarm::report {

/// Terminal columns that UTF-8 `text` takes: two for wide East Asian characters, none for combining
/// marks. A byte that is not UTF-8, and a control character, counts as one.
std::size_t display_width(std::string_view text);

/// `text` with U+FFFD for what cannot stand in an XML document: bytes that are not UTF-8, and
/// control characters other than line feeds.
std::string printable(std::string_view text);

}  // namespace flexarm::report
