#include "measured/files/text_encoding.hpp"

#include "arm/input_error.hpp"
#include "arm/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
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

std::string from_utf16(string_view bytes, bool big_endian) {
  if (bytes.size() % 2 != 0) throw InputError("not text: UTF-16 with an odd number of bytes");
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at]));
    const auto second = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + 1]));
    return big_endian ? first << 8U | second : second << 8U | first;
  };
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    std::uint32_t code = unit(at);
    if (code >= 0xd800U && code < 0xe000U) {
      const std::uint32_t low = at + 3 < bytes.size() ? unit(at + 2) : 0;
      if (code >= 0xdc00U || low < 0xdc00U || low >= 0xe000U) {
        throw InputError(fmt::format("not text: half a UTF-16 pair at byte {}", at));
      }
      code = 0x10000U + ((code - 0xd800U) << 10U) + (low - 0xdc00U);
      at += 2;
    }
    append_utf8(out, code);
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

}  // namespace flexarm::measured
