#pragma once

namespace flexarm::arm {

// These return the kind of a character of UTF-8, whatever the locale.

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

constexpr bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Returns whether `c` is a byte of a character that is not ASCII, such as a Greek letter.
constexpr bool is_beyond_ascii(char c) {
  return static_cast<unsigned char>(c) >= 0x80U;
}

}  // namespace flexarm::arm
