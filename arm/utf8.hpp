#pragma once

#include <cstddef>
#include <string_view>

namespace flexarm::arm {

/// Bytes of the UTF-8 sequence at the beginning of `text` (RFC 3629: no overlong forms, no
/// surrogates, up to U+10FFFF), 1 to 4; 0 when there is none.
std::size_t utf8_sequence_length(std::string_view text);

/// Whether the whole of `text` is UTF-8.
bool is_utf8(std::string_view text);

}  // namespace flexarm::arm
