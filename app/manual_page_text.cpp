#include "app/manual_page_text.hpp"

#include "app/build_facts.hpp"

#include <fmt/format.h>

#include <cctype>
#include <sstream>

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
    names += fmt::format(" \\fI{}\\fR{}", roff(option.value), option.is_list ? " ..." : "");
  }
  std::string text = roff(option.text);
  if (!option.default_value.empty()) {
    text += fmt::format(" (default: {})", roff(option.default_value));
  }
  return fmt::format(".TP\n{}\n{}\n", names, text);
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

/// "Exit status: 0 success; ..." as a section, an example with its lines as they stand.
std::string footer_sections(const std::string& footer) {
  std::string text;
  std::istringstream lines(footer);
  bool verbatim = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_indented = line.starts_with("  ");
    if (is_indented != verbatim) text += is_indented ? ".nf\n" : ".fi\n";
    verbatim = is_indented;
    if (line.empty()) continue;
    const auto colon = line.find(':');
    const bool is_heading = !is_indented && colon != std::string::npos;
    if (!is_heading) {
      text += roff(line) + "\n";
      continue;
    }
    text += fmt::format(".SH {}\n", roff(upper_case(line.substr(0, colon))));
    const auto begin = line.find_first_not_of(' ', colon + 1);
    if (begin != std::string::npos) text += roff(line.substr(begin)) + "\n";
  }
  return text + (verbatim ? ".fi\n" : "");
}

std::string argument_words(const CommandDescription& command) {
  std::string words;
  for (const auto& option : command.options) {
    if (!option.is_positional) continue;
    const std::string word =
        fmt::format("\\fI{}\\fR{}", roff(option.names.back()), option.is_list ? " ..." : "");
    words += option.is_required ? " " + word : fmt::format(" [{}]", word);
  }
  return words;
}

}  // namespace

std::string manual_page(const CommandDescription& program,
                        const std::vector<CommandDescription>& commands) {
  std::string text = header("flexarm", "finds what the simulation of a flexible arm gets wrong") +
                     "\\fBflexarm\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n" +
                     roff(program.summary) + ".SH COMMANDS\n";
  for (const auto& command : commands) {
    text += fmt::format(".TP\n\\fBflexarm\\-{}\\fR(1)\n{}\n", roff(command.name),
                        roff(command.summary));
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
