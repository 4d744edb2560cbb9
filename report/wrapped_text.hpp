#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::report {

/// The words of `text`, separated by blanks, in lines: the first of at most `first_width` columns,
/// the others of at most `width`. A longer word has a line of its own. No line for a text without
/// words.
std::vector<std::string> wrapped(std::string_view text, std::size_t first_width, std::size_t width);

/// The columns of its longest word.
std::size_t longest_word(std::string_view text);

}  // namespace flexarm::report
