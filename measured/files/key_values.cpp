#include "measured/files/key_values.hpp"

#include "arm/decimal_comma.hpp"
#include "arm/input_error.hpp"
#include "measured/files/delimited_line.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::measured {

KeyValues read_key_values(std::string_view text, std::string_view allowed) {
  KeyValues read;
  while (!text.empty()) {
    const auto comma = std::min(text.find(','), text.size());
    const std::string_view part = trimmed(text.substr(0, comma));
    text.remove_prefix(std::min(comma + 1, text.size()));
    const auto equals = part.find('=');
    if (equals == std::string_view::npos) {
      if (!read.empty() && arm::may_be_decimals("=" + read.back().second, part)) {
        const std::string pair =
            fmt::format("{}={},{}", read.back().first, read.back().second, part);
        throw arm::InputError(fmt::format("{}: the comma separates keys{}", arm::shown(pair),
                                          arm::decimal_comma_hint(pair)));
      }
      throw arm::InputError(fmt::format("{}: must be {}", arm::shown(part), allowed));
    }
    const std::string key(trimmed(part.substr(0, equals)));
    if (std::ranges::count(read, key, &KeyValues::value_type::first) > 0) {
      throw arm::InputError(fmt::format("{}: given twice", arm::shown(key)));
    }
    read.emplace_back(key, trimmed(part.substr(equals + 1)));
  }
  return read;
}

}  // namespace flexarm::measured
