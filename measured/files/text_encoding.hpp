#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// The bytes of a text as UTF-8, and what they were.
struct DecodedText {
  std::string utf8;      ///< without a byte-order mark
  const char* encoding;  ///< "UTF-8", "UTF-16" or "Latin-1"
};

/// UTF-16 is told by its byte-order mark; what is neither that nor UTF-8 is taken for Latin-1.
/// Throws InputError "not text: ..." for bytes that hold control characters, as no text does, and
/// UTF-16 that is none; not located.
DecodedText decode_text(std::string_view bytes);

/// The text of UTF-16 code units as UTF-8; empty where one is a control character, half a pair or
/// no unit at all.
std::optional<std::string> text_of_units(std::span<const double> units);

}  // namespace flexarm::measured
