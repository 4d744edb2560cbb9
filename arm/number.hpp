#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace flexarm::arm {

/// The whole of `text` as a number with a decimal point whatever the locale, `nan` and `inf`
/// included; nothing when any of it is no number, a leading + or blank, or does not fit a T.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace flexarm::arm
