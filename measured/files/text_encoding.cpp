#include "measured/files/text_encoding.hpp"

#include "arm/input_error.hpp"
#include "arm/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

void append_utf8(std::string& out, std::uint32_t code) {
  const auto tail = [&](unsigned shift) {
    out += static_cast<char>(0x80U | ((code >> shift) & 0x3fU));
  };
  if (code < 0x80U) {
    out += static_cast<char>(code);
  } else if (code < 0x800U) {
    out += static_cast<char>(0xc0U | (code >> 6U));
    tail(0);
  } else if (code < 0x10000U) {
    out += static_cast<char>(0xe0U | (code >> 12U));
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xf0U | (code >> 18U));
    tail(12);
    tail(6);
    tail(0);
  }
}

struct Letter {
  std::uint32_t code = 0;
  std::size_t units = 1;
};

/// The letter of a UTF-16 code unit and the one behind it, 0 where there is none; empty for half a
/// pair.
std::optional<Letter> letter_of(std::uint32_t unit, std::uint32_t next) {
  if (unit < 0xd800U || unit >= 0xe000U) return Letter{unit};
  if (unit >= 0xdc00U || next < 0xdc00U || next >= 0xe000U) return std::nullopt;
  return Letter{0x10000U + ((unit - 0xd800U) << 10U) + (next - 0xdc00U), 2};
}

std::string from_utf16(string_view bytes, bool big_endian) {
  if (bytes.size() % 2 != 0) throw InputError("not text: UTF-16 with an odd number of bytes");
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at]));
    const auto second = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + 1]));
    return big_endian ? first << 8U | second : second << 8U | first;
  };
  std::string out;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto letter = letter_of(unit(at), at + 3 < bytes.size() ? unit(at + 2) : 0);
    if (!letter) throw InputError(fmt::format("not text: half a UTF-16 pair at byte {}", at));
    append_utf8(out, letter->code);
    at += 2 * letter->units;
  }
  return out;
}

std::string from_latin1(string_view bytes) {
  std::string out;
  for (const char c : bytes) append_utf8(out, static_cast<unsigned char>(c));
  return out;
}

void require_no_controls(string_view text) {
  const auto is_control = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && (code < '\t' || code > '\r')) || code == 0x7f;
  };
  const auto bad = std::ranges::find_if(text, is_control);
  if (bad == text.end()) return;
  throw InputError(fmt::format(
      "not text: byte {:#04x} at place {}; must be delimited text, a universal file or a MATLAB "
      "file",
      static_cast<unsigned>(static_cast<unsigned char>(*bad)), bad - text.begin() + 1));
}

}  // namespace

DecodedText decode_text(string_view bytes) {
  constexpr string_view kMark8 = "\xef\xbb\xbf";
  if (bytes.starts_with(kMark8)) bytes.remove_prefix(kMark8.size());
  DecodedText text{"", "UTF-8"};
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    text = {from_utf16(bytes.substr(2), bytes.front() == '\xfe'), "UTF-16"};
  } else if (arm::is_utf8(bytes)) {
    text.utf8 = std::string(bytes);
  } else {
    require_no_controls(bytes);
    text = {from_latin1(bytes), "Latin-1"};
  }
  require_no_controls(text.utf8);
  return text;
}

std::optional<std::string> text_of_units(std::span<const double> units) {
  constexpr double kUnits = 0x1p16;
  const auto is_unit = [](double unit) {
    return unit >= ' ' && unit != 0x7f && unit < kUnits && unit == std::floor(unit);
  };
  if (!std::ranges::all_of(units, is_unit)) return std::nullopt;
  std::string out;
  for (std::size_t at = 0; at < units.size();) {
    const double next = at + 1 < units.size() ? units[at + 1] : 0.0;
    const auto letter =
        letter_of(static_cast<std::uint32_t>(units[at]), static_cast<std::uint32_t>(next));
    if (!letter) return std::nullopt;
    append_utf8(out, letter->code);
    at += letter->units;
  }
  return out;
}

}  // namespace flexarm::measured
