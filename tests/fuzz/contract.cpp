#include "tests/fuzz/contract.hpp"

#include "arm/input_error.hpp"
#include "arm/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

namespace flexarm::fuzz {

namespace {

/// Whether a sequence of UTF-8 is a control character.
bool is_control(std::string_view sequence) {
  const auto first = static_cast<unsigned char>(sequence.front());
  if (sequence.size() == 1) return first < 0x20 || first == 0x7f;
  return first == 0xc2 && static_cast<unsigned char>(sequence[1]) < 0xa0;
}

}  // namespace

void require_clean_line(std::string_view text) {
  if (text.empty()) throw Finding("an empty line");
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = arm::utf8_sequence_length(rest);
    if (length == 0 || is_control(rest.substr(0, length))) {
      throw Finding(fmt::format("byte {} of a line is no text: {}", text.size() - rest.size(),
                                arm::shown(text, 1000)));
    }
    rest.remove_prefix(length);
  }
}

bool returns_or_refuses(const std::function<void()>& read) {
  try {
    read();
    return true;
  } catch (const arm::InputError& error) {
    require_clean_line(error.what());
    return false;
  } catch (const Finding&) {
    throw;
  } catch (const std::exception& error) {
    throw Finding(fmt::format("no InputError: {}", error.what()));
  }
}

void require(bool holds, const char* what) {
  if (!holds) throw Finding(what);
}

}  // namespace flexarm::fuzz
