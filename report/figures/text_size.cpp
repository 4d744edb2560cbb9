#include "report/figures/text_size.hpp"

#include "report/utf8_text.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace flexarm::report {

double TextSize::width_px(const std::string& text) const {
  std::size_t widest = 0;
  std::string_view rest = text;
  while (true) {
    const std::size_t end = rest.find('\n');
    widest = std::max(widest, display_width(rest.substr(0, end)));
    if (end == std::string_view::npos) return character_px() * static_cast<double>(widest);
    rest.remove_prefix(end + 1);
  }
}

std::string TextSize::wrapped(const std::string& text, double width_px) const {
  std::string lines;
  std::string line;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = begin == 0 ? word : line + " " + word;
    if (begin > 0 && this->width_px(longer) > width_px) {
      lines += line + "\n";
      line = word;
    } else {
      line = longer;
    }
    begin = end + 1;
  }
  return lines + line;
}

int line_count(const std::string& text) {
  return 1 + static_cast<int>(std::ranges::count(text, '\n'));
}

}  // namespace flexarm::report
