#include "tests/structure/texts.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <sstream>
#include <string_view>

namespace flexarm::texts {

namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// A position in C++ source that counts its lines.
class Source {
 public:
  explicit Source(const std::string& text) : text_(text) {}

  bool at_end() const { return at_ >= text_.size(); }
  bool looking_at(std::string_view what) const {
    return text_.compare(at_, what.size(), what) == 0;
  }
  char here() const { return text_[at_]; }
  char before() const { return at_ == 0 ? '\n' : text_[at_ - 1]; }
  int line() const { return line_; }

  char take() {
    if (text_[at_] == '\n') ++line_;
    return text_[at_++];
  }

  /// Passes over everything up to and including `end`.
  std::string take_until(std::string_view end) {
    std::string taken;
    while (!at_end() && !looking_at(end)) taken += take();
    for (std::size_t i = 0; i < end.size() && !at_end(); ++i) take();
    return taken;
  }

  /// The inside of the literal that begins here.
  std::string take_literal(char quote) {
    std::string inside;
    take();
    while (!at_end() && here() != quote) {
      if (here() == '\\') {
        take();
        const char escaped = take();
        inside += escaped == 'n' || escaped == 't' ? ' ' : escaped;
      } else {
        inside += take();
      }
    }
    if (!at_end()) take();
    return inside;
  }

  std::string take_raw_literal() {
    take_until("\"");
    const std::string delimiter = take_until("(");
    return take_until(")" + delimiter + "\"");
  }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::string on_one_line(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  for (std::string word; in >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::vector<Text> literals(const std::string& source, const std::string& file) {
  std::vector<Text> found;
  bool joins = false;  // nothing but blanks and comments since the last literal
  const auto add = [&](const std::string& inside, int line) {
    if (joins) {
      found.back().text += inside;
    } else {
      found.push_back({file + ":" + std::to_string(line), inside});
    }
    joins = true;
  };
  for (Source at(source); !at.at_end();) {
    if (at.looking_at("//")) {
      at.take_until("\n");
    } else if (at.looking_at("/*")) {
      at.take_until("*/");
    } else if (at.here() == '#' && at.before() == '\n') {
      at.take_until("\n");
    } else if (at.looking_at("R\"") && !is_word(at.before())) {
      const int line = at.line();
      add(at.take_raw_literal(), line);
    } else if (at.here() == '"') {
      const int line = at.line();
      add(at.take_literal('"'), line);
    } else if (at.here() == '\'' && !is_word(at.before())) {
      at.take_literal('\'');
      joins = false;
    } else if (std::isspace(static_cast<unsigned char>(at.take())) == 0) {
      joins = false;
    }
  }
  for (Text& one : found) one.text = on_one_line(one.text);
  return found;
}

std::vector<Text> paragraphs(const std::string& markdown, const std::string& file,
                             bool with_tables) {
  static const std::regex item(R"((?:[-*]|\d+\.)\s+)");
  std::vector<Text> found;
  bool open = false;  // the last paragraph goes on
  bool in_code = false;
  int number = 0;
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string text = on_one_line(line);
    const std::string where = file + ":" + std::to_string(number);
    if (text.starts_with("```")) {
      in_code = !in_code;
      open = false;
      continue;
    }
    if (in_code) continue;
    const bool is_indented_code = !open && line.starts_with("    ");
    if (text.empty() || text.starts_with("![") || text.starts_with("<!--") || is_indented_code) {
      open = false;
    } else if (text.starts_with("|") || text.starts_with("#")) {
      if (with_tables) found.push_back({where, text});
      open = false;
    } else {
      std::smatch match;
      const bool is_item =
          std::regex_search(text, match, item, std::regex_constants::match_continuous);
      if (is_item || !open) {
        found.push_back({where, is_item ? match.suffix().str() : text});
      } else {
        found.back().text += " " + text;
      }
      open = true;
    }
  }
  return found;
}

std::vector<std::string> sentences(const std::string& paragraph) {
  constexpr std::array<std::string_view, 11> kAbbreviations = {
      "e.g.", "i.e.", "fig.", "std.", "dev.", "no.", "eq.", "vs.", "cf.", "al.", "..."};
  static const std::regex formula(R"(\$\$.*?\$\$|\$[^$]*\$)");
  static const std::regex code("`[^`]*`");
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  static const std::regex emphasis(R"(\*)");
  std::string text = std::regex_replace(paragraph, code, "code");
  text = std::regex_replace(text, formula, "formula");
  text = std::regex_replace(text, link, "$1");
  text = std::regex_replace(text, emphasis, "");
  std::vector<std::string> found(1);
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    found.back() += (found.back().empty() ? "" : " ") + word;
    const auto last = word.find_last_not_of(")\"'");
    const std::string core = last == std::string::npos ? "" : lower(word.substr(0, last + 1));
    const bool ends =
        !core.empty() && std::string_view(".!?").find(core.back()) != std::string_view::npos;
    if (ends && std::ranges::find(kAbbreviations, core) == kAbbreviations.end()) {
      found.emplace_back();
    }
  }
  if (found.back().empty()) found.pop_back();
  return found;
}

int words(const std::string& sentence) {
  int count = 0;
  std::istringstream in(sentence);
  for (std::string word; in >> word;) {
    if (std::ranges::any_of(word, [](char c) { return is_word(c) || (c & 0x80) != 0; })) ++count;
  }
  return count;
}

bool contains_phrase(const std::string& text, const std::string& phrase) {
  const std::string in = lower(text);
  const std::string what = lower(phrase);
  for (auto at = in.find(what); at != std::string::npos; at = in.find(what, at + 1)) {
    const auto end = at + what.size();
    if ((at == 0 || !is_word(in[at - 1])) && (end == in.size() || !is_word(in[end]))) return true;
  }
  return false;
}

}  // namespace flexarm::texts
