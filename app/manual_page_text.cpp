#include "app/manual_page_text.hpp"

#include "app/build_facts.hpp"
#include "app/option_values.hpp"
#include "report/wrapped_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <string_view>

namespace flexarm::app {

namespace {

/// Text as roff has it: a hyphen that is typed is a minus, and no line begins with a request.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      const bool is_request = (c == '.' || c == '\'') && (result.empty() || result.back() == '\n');
      result += (is_request ? "\\&" : "") + std::string(1, c);
    }
  }
  return result;
}

/// Text in lines of a source file, each with its end.
std::string roff_lines(std::string_view text) {
  constexpr std::size_t kWidth = 76;
  std::string lines;
  for (const auto& line : report::wrapped(text, kWidth, kWidth)) lines += roff(line) + "\n";
  return lines;
}

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string header(const std::string& name, const std::string& summary) {
  return fmt::format(
      ".TH {} 1 \"\" \"flexarm {}\" \"flexarm manual\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
      roff(upper_case(name)), kVersion, roff(name), roff(summary));
}

std::string option_item(const OptionDescription& option) {
  std::string names;
  for (const auto& name : option.names) {
    names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  }
  if (!option.value.empty() && !option.is_positional) {
    names += fmt::format(" \\fI{}\\fR", roff(value_name(option)));
  }
  return fmt::format(".TP\n{}\n{}", names, roff_lines(text_with_default(option)));
}

/// The options or the positional arguments under a heading; nothing where there are none.
std::string option_section(const char* heading, const CommandDescription& command,
                           bool positional) {
  std::string items;
  for (const auto& option : command.options) {
    if (option.is_positional == positional) items += option_item(option);
  }
  return items.empty() ? "" : fmt::format(".SH {}\n{}", heading, items);
}

/// The heading that a line of a footer begins with, as "Exit status" of "Exit status: 0 success";
/// empty where what is in front of the first colon is a sentence, or part of one.
std::string heading_of(const std::string& line) {
  constexpr std::ptrdiff_t kMostBlanks = 2;
  const std::string heading = line.substr(0, std::min(line.find(':'), line.size()));
  const bool is_one = heading.size() < line.size() && heading.find('.') == std::string::npos &&
                      std::ranges::count(heading, ' ') <= kMostBlanks;
  return is_one ? heading : "";
}

/// An indented line of a footer: a term and its definition, or a line that stays as it stands.
std::string indented_item(const std::string& line) {
  const auto term = line.find_first_not_of(' ');
  const auto blanks = line.find("  ", term);
  if (line.find("flexarm ") != std::string::npos || blanks == std::string::npos) {
    return ".nf\n" + roff(line) + "\n.fi\n";
  }
  return fmt::format(".TP\n{}\n{}", roff(line.substr(term, blanks - term)),
                     roff_lines(line.substr(blanks)));
}

/// A section for each heading. Lines without one are paragraphs of the section before.
std::string footer_sections(const std::string& footer) {
  std::string text;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line.starts_with("  ")) {
      text += indented_item(line);
      continue;
    }
    const std::string heading = heading_of(line);
    if (heading.empty()) {
      text += ".PP\n" + roff_lines(line);
    } else {
      text += fmt::format(".SH {}\n", roff(upper_case(heading)));
      text += roff_lines(line.substr(heading.size() + 1));
    }
  }
  return text;
}

std::string argument_words(const CommandDescription& command) {
  std::string words;
  for (const auto& option : command.options) {
    if (!option.is_positional) continue;
    const std::string word =
        fmt::format("\\fI{}\\fR{}", roff(option.names.back()), option.is_repeatable ? " ..." : "");
    words += option.is_required ? " " + word : fmt::format(" [{}]", word);
  }
  return words;
}

}  // namespace

std::string manual_page(const CommandDescription& program,
                        const std::vector<CommandDescription>& commands) {
  std::string text = header("flexarm", "finds what the simulation of a flexible arm gets wrong") +
                     "\\fBflexarm\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n" +
                     roff_lines(program.summary) + ".SH COMMANDS\n";
  for (const auto& command : commands) {
    text += fmt::format(".TP\n\\fBflexarm\\-{}\\fR(1)\n{}", roff(command.name),
                        roff_lines(command.summary));
  }
  return text + option_section("OPTIONS", program, false) + footer_sections(program.footer);
}

std::string manual_page(const CommandDescription& command) {
  return header("flexarm-" + command.name, command.summary) +
         fmt::format("\\fBflexarm {}\\fR [\\fIOPTIONS\\fR]{}\n", roff(command.name),
                     argument_words(command)) +
         option_section("ARGUMENTS", command, true) + option_section("OPTIONS", command, false) +
         footer_sections(command.footer) + ".SH SEE ALSO\n\\fBflexarm\\fR(1)\n";
}

}  // namespace flexarm::app
