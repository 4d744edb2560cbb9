#include "measured/files/toml_depth.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace flexarm::measured {

namespace {

using std::string_view;

/// Walks a document and knows how many levels surround a place.
class DepthScan {
 public:
  explicit DepthScan(string_view toml) : toml_(toml) {}

  std::optional<int> run() {
    for (at_ = 0; at_ < toml_.size(); ++at_) {
      pass(toml_[at_]);
      if (levels_ > kDeepestToml) return line_;
    }
    return std::nullopt;
  }

 private:
  void pass(char c) {
    switch (c) {
      case '\n':
        end_line();
        return;
      case ' ':
      case '\t':
      case '\r':
        return;
      case '#':
        at_ = std::min(toml_.find('\n', at_), toml_.size()) - 1;
        return;
      case '"':
      case '\'':
        pass_text(c);
        break;
      case '[':
        if (begins_line_) {
          is_header_ = true;
          levels_ = 1;
          break;
        }
        [[fallthrough]];
      case '{':
        if (is_header_) break;
        open_.push_back(levels_);
        ++levels_;
        break;
      case ']':
      case '}':
        if (is_header_ || open_.empty()) break;
        levels_ = open_.back();
        open_.pop_back();
        break;
      case ',':
        if (!open_.empty()) levels_ = open_.back() + 1;
        break;
      case '.':
        ++levels_;
        break;
      default:
        break;
    }
    begins_line_ = false;
  }

  /// Keys stand below the last header; an array may go on, but no key does.
  void end_line() {
    ++line_;
    if (is_header_) header_levels_ = levels_;
    is_header_ = false;
    levels_ = open_.empty() ? header_levels_ : open_.back() + 1;
    begins_line_ = open_.empty();
  }

  /// To the quote that closes the text; one on a line ends with it.
  void pass_text(char quote) {
    const std::string three(3, quote);
    const bool is_long = toml_.substr(at_).starts_with(three);
    at_ += is_long ? 3 : 1;
    for (; at_ < toml_.size(); ++at_) {
      if (toml_[at_] == '\\' && quote == '"' && !toml_.substr(at_ + 1).starts_with('\n')) {
        ++at_;
      } else if (toml_[at_] == '\n') {
        if (!is_long) {
          --at_;
          return;
        }
        ++line_;
      } else if (is_long && toml_.substr(at_).starts_with(three)) {
        at_ += 2;
        return;
      } else if (!is_long && toml_[at_] == quote) {
        return;
      }
    }
  }

  string_view toml_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool begins_line_ = true;
  bool is_header_ = false;
  std::size_t header_levels_ = 0;
  std::size_t levels_ = 0;
  std::vector<std::size_t> open_;  ///< levels in front of each open bracket
};

}  // namespace

std::optional<int> line_too_deep(string_view toml) {
  return DepthScan(toml).run();
}

}  // namespace flexarm::measured
