#include "measured/files/text_lines.hpp"

#include <algorithm>
#include <cstddef>

namespace flexarm::measured {

using std::string_view;

bool LineReader::next(TextLine& line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  line = {++number_, text_.substr(at_, end - at_)};
  at_ = end + 1;
  if (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n') ++at_;
  return true;
}

bool is_blank_line(string_view line) {
  return line.find_first_not_of(" \t\f\v") == string_view::npos;
}

string_view without_comment_mark(string_view line) {
  const auto first = line.find_first_not_of(" \t");
  if (first == string_view::npos) return line;
  string_view rest = line.substr(first);
  if (rest.starts_with("//")) return rest.substr(2);
  while (rest.starts_with('#') || rest.starts_with('%')) rest.remove_prefix(1);
  return rest.size() == line.size() - first ? line : rest;
}

bool is_comment(string_view line) {
  return without_comment_mark(line).size() != line.size();
}

}  // namespace flexarm::measured
