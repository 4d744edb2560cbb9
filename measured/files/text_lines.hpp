#pragma once

#include <string_view>

namespace flexarm::measured {

/// A line of a text without its end.
struct TextLine {
  int number = 0;  ///< from 1
  std::string_view text;
};

/// Passes over the lines of a text one by one; they end in LF, CRLF or CR.
class LineReader {
 public:
  /// `text` must outlive the lines.
  explicit LineReader(std::string_view text) : text_(text) {}

  bool next(TextLine& line);
  /// Whether the line read last has no end, as the last one of a text that is cut off.
  bool is_open() const { return at_ > text_.size(); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

bool is_blank_line(std::string_view line);

/// The line without its comment mark, #, % or //; the line itself when it has none.
std::string_view without_comment_mark(std::string_view line);

bool is_comment(std::string_view line);

}  // namespace flexarm::measured
