#include "arm/input_error.hpp"

#include "arm/utf8.hpp"

#include <fmt/format.h>

#include <utility>

namespace flexarm::arm {

InputError::InputError(const std::string& line, std::string key)
    : std::runtime_error(line), key_(std::move(key)) {}

InputError out_of_range(const std::string& key, double value, const std::string& unit,
                        const std::string& allowed) {
  return InputError(
      fmt::format("{} = {}{}{}: must be {}", key, value, unit.empty() ? "" : " ", unit, allowed),
      key);
}

void require_in_range(const std::string& key, double value, const std::string& unit,
                      const Range& range) {
  if (!range.contains(value)) throw out_of_range(key, value, unit, to_string(range));
}

InputError located(const InputError& error, const std::string& file, int line) {
  return InputError(line > 0 ? fmt::format("{}:{}: {}", file, line, error.what())
                             : fmt::format("{}: {}", file, error.what()),
                    error.key());
}

namespace {

/// Whether a character of UTF-8 is a control character, U+0080 to U+009F included.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character.front());
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

}  // namespace

std::string shown(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_sequence_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    if (length == 0 || is_control(character)) {
      for (const char byte : character) {
        out += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
      }
    } else {
      out += character;
    }
    text.remove_prefix(character.size());
    if (out.size() >= longest && !text.empty()) return out + "...";
  }
  return out;
}

}  // namespace flexarm::arm
