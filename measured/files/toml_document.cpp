#include "measured/files/toml_document.hpp"

#include "arm/input_error.hpp"
#include "measured/files/toml_depth.hpp"

#include <fmt/format.h>

#include <array>
#include <regex.h>
#include <stdexcept>

namespace flexarm::measured {

namespace {

struct Slip {
  const char* pattern;  ///< POSIX extended expression, of the line that the parser stopped at
  const char* advice;
};

// In order: the first that matches is given.
constexpr std::array<Slip, 15> kSlips = {{
    {"\r", "end lines with a line feed"},
    {"\xc2\xa0", "there is a no-break space; write a plain one"},
    {"\xe2\x88\x92", "write the minus sign as -"},
    {"\xe2\x80(\x9c|\x9d|\x9e)", "write straight quotes"},
    {"= *[-+]?[0-9]+,[0-9]", "write numbers with a decimal point and no comma"},
    {"= *[-+]?\\.[0-9]", "write a digit before the point, as in 0.5"},
    {"= *[-+]?[0-9]+\\.([^0-9]|$)", "write a digit after the point, as in 1.0"},
    {"= *[-+]?[0-9.]+[dD][-+]?[0-9]", "write the exponent with e, as in 1e-3"},
    {"= *[-+0-9.eE]+ *(%|//)", "a comment begins with #"},
    {"= *[-+0-9.eE]+ *[*/^]", "write one number, not an expression"},
    {"= *[-+0-9.eE]+ *;", "end the line without a semicolon"},
    {"= *[-+]?[0-9][0-9.]*([eE][-+]?[0-9]+)? *([^] 0-9.,#eE]|[eE][^-+0-9])",
     "write the number alone; its unit may follow as a comment, after #"},
    {"= *[A-Za-z]", "write text in quotes"},
    {"= *\"[^\"]*$", "close the quotes on the same line"},
    {"^ *[A-Za-z0-9_-]+( *:| +[-+0-9])", "write key = value, with an equals sign"},
}};

/// A compiled expression that frees itself. std::regex recurses once a character of the line.
class Expression {
 public:
  explicit Expression(const char* pattern) {
    if (::regcomp(&compiled_, pattern, REG_EXTENDED | REG_NOSUB) != 0) {
      throw std::logic_error(fmt::format("bad expression {}", pattern));
    }
  }
  ~Expression() { ::regfree(&compiled_); }
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;

  bool matches(const std::string& line) const {
    return ::regexec(&compiled_, line.c_str(), 0, nullptr, 0) == 0;
  }

 private:
  regex_t compiled_ = {};
};

std::string_view line_of(std::string_view text, int line) {
  for (int skipped = 1; skipped < line; ++skipped) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

/// "; write ..." for a slip that is recognised, else "".
std::string advice_on(const std::string& line) {
  for (const auto& slip : kSlips) {
    if (Expression(slip.pattern).matches(line)) return fmt::format("; {}", slip.advice);
  }
  return "";
}

std::string complaint_of(const toml::parse_error& error) {
  constexpr std::string_view kPrefix = "Error while parsing ";
  std::string_view description = error.description();
  if (description.starts_with(kPrefix)) description.remove_prefix(kPrefix.size());
  // The parser shows what it saw as '\n' where the line ends too early.
  std::string complaint(description);
  constexpr std::string_view kSawEnd = R"(saw '\n')";
  if (complaint.ends_with(kSawEnd)) {
    complaint.replace(complaint.size() - kSawEnd.size(), kSawEnd.size(), "the line ended");
  }
  constexpr std::size_t kLongest = 200;
  return arm::shown(complaint, kLongest);
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file_name) {
  if (const auto line = line_too_deep(text)) {
    throw located(arm::InputError(fmt::format("keys within keys of more than {0} levels; at most "
                                              "{0} are read",
                                              kDeepestToml)),
                  file_name, *line);
  }
  try {
    return toml::parse(text, std::string_view(file_name));
  } catch (const toml::parse_error& error) {
    const int line = static_cast<int>(error.source().begin.line);
    const std::string content(line_of(text, line));
    throw located(
        arm::InputError(fmt::format("not TOML: {}{}; the line reads: {}", complaint_of(error),
                                    advice_on(content), arm::shown(content))),
        file_name, line);
  }
}

}  // namespace flexarm::measured
