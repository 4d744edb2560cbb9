#pragma once

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::arm {

/// The one of `values` that `word` names by its `to_string`. Throws InputError, which begins with
/// `option`, with the words allowed, and the one that was probably meant.
template <class T, std::size_t N>
T read_word(std::string_view option, const std::string& word, const std::array<T, N>& values) {
  std::vector<std::string> words;
  for (const T value : values) {
    words.emplace_back(to_string(value));
    if (word == words.back()) return value;
  }
  throw InputError(fmt::format("{} {}: must be {}{}", option, shown(word), fmt::join(words, " or "),
                               did_you_mean(word, words)));
}

}  // namespace flexarm::arm
