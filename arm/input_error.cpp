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

std::string shown(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_sequence_length(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (length == 0 || byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
    if (out.size() >= longest && !text.empty()) return out + "...";
  }
  return out;
}

}  // namespace flexarm::arm
