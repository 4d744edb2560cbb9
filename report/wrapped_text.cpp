#include "report/wrapped_text.hpp"

#include "report/utf8_text.hpp"

#include <algorithm>
#include <sstream>

namespace flexarm::report {

std::vector<std::string> wrapped(std::string_view text, std::size_t first_width,
                                 std::size_t width) {
  std::istringstream words{std::string(text)};
  std::vector<std::string> lines;
  for (std::string word; words >> word;) {
    const std::size_t room = lines.size() == 1 ? first_width : width;
    const bool fits =
        !lines.empty() && display_width(lines.back()) + 1 + display_width(word) <= room;
    if (fits) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::size_t longest_word(std::string_view text) {
  std::istringstream words{std::string(text)};
  std::size_t longest = 0;
  for (std::string word; words >> word;) longest = std::max(longest, display_width(word));
  return longest;
}

}  // namespace flexarm::report
