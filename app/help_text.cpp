#include "app/help_text.hpp"

#include "app/option_groups.hpp"
#include "app/option_tree.hpp"
#include "app/option_values.hpp"
#include "app/screen.hpp"
#include "report/wrapped_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::app {

namespace {

constexpr std::size_t kWidestHelp = 80;
/// Where the texts of options and commands begin.
constexpr std::size_t kTextColumn = 26;
/// On a narrower terminal they stand below the names.
constexpr std::size_t kLeastBeside = 56;
constexpr std::size_t kBelow = 6;

std::size_t help_width() {
  return std::min(screen_width(), kWidestHelp);
}

/// `head`, and the words of `text` from column `column` on; below the head where it is too long.
std::string hanging(const std::string& head, std::string_view text, std::size_t column) {
  const bool is_narrow = help_width() < kLeastBeside;
  if (is_narrow) column = kBelow;
  const std::size_t room = help_width() - column;
  std::string lines = head;
  bool beside = !is_narrow && head.size() + 2 <= column;
  for (const auto& line : report::wrapped(text, room, room)) {
    if (beside) {
      lines.append(column - lines.size(), ' ');
    } else {
      lines += "\n" + std::string(column, ' ');
    }
    beside = false;
    lines += line;
  }
  return lines + "\n";
}

std::string paragraph(std::string_view text) {
  std::string lines;
  for (const auto& line : report::wrapped(text, help_width(), help_width())) lines += line + "\n";
  return lines;
}

std::string option_line(const OptionDescription& option) {
  std::string head = fmt::format("  {}", fmt::join(option.names, ", "));
  if (!option.is_positional && !option.value.empty()) head += " " + value_name(option);
  return hanging(head, text_with_default(option), kTextColumn);
}

std::string usage(const CommandDescription& command, bool is_program) {
  std::string line =
      is_program ? "flexarm COMMAND [OPTIONS]" : fmt::format("flexarm {} [OPTIONS]", command.name);
  for (const auto& option : command.options) {
    if (!option.is_positional) continue;
    const std::string name = option.names.front() + (option.is_repeatable ? "..." : "");
    line += option.is_required ? " " + name : fmt::format(" [{}]", name);
  }
  return fmt::format("Usage: {}\n", line);
}

/// Lines of a command are left whole, so that they can be copied; definitions hang.
std::string footer_text(const std::string& footer) {
  std::string text;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    const auto words = line.find_first_not_of(' ');
    const bool is_command = line.find("flexarm ") == words || line.starts_with("      ");
    if (words == std::string::npos || line.size() <= help_width() || is_command) {
      text += line + "\n";
      continue;
    }
    const auto blanks = line.find("  ", words);
    const auto rest = blanks == std::string::npos ? blanks : line.find_first_not_of(' ', blanks);
    text += rest == std::string::npos ? paragraph(line)
                                      : hanging(line.substr(0, blanks), line.substr(rest), rest);
  }
  return text;
}

std::string arguments_text(const CommandDescription& command) {
  std::string text;
  for (const auto& option : command.options) {
    if (option.is_positional) text += option_line(option);
  }
  return text.empty() ? "" : "\nArguments:\n" + text;
}

std::string options_text(const CommandDescription& command, const std::string& name) {
  std::string text;
  for (const auto& heading : option_groups(name)) {
    std::string lines;
    for (const auto& option : command.options) {
      if (option.is_positional || group_of(name, option.names.back()) != heading) continue;
      lines += option_line(option);
    }
    if (!lines.empty()) text += fmt::format("\n{}:\n{}", heading, lines);
  }
  return text;
}

/// The commands under the headings that CLI::App::group gives them.
std::string commands_text(const CLI::App& program) {
  std::vector<std::string> headings;
  std::vector<std::string> texts;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string& heading = command->get_group();
    if (heading.empty()) continue;
    const auto at = std::ranges::find(headings, heading);
    const auto index = static_cast<std::size_t>(at - headings.begin());
    if (at == headings.end()) {
      headings.push_back(heading);
      texts.emplace_back();
    }
    constexpr std::size_t kCommandColumn = 14;
    texts[index] += hanging("  " + command->get_name(), command->get_description(), kCommandColumn);
  }
  std::string text;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    text += fmt::format("\n{}:\n{}", headings[i], texts[i]);
  }
  return text;
}

std::string help_text(const CLI::App* parser, const std::string& /*name*/,
                      CLI::AppFormatMode /*mode*/) {
  const bool is_program = parser->get_parent() == nullptr;
  // The tree of one parser: describe_program takes any.
  const CommandDescription command = describe_program(*parser);
  const std::string name = is_program ? "" : command.name;
  std::string text = paragraph(command.summary) + "\n" + usage(command, is_program);
  text += arguments_text(command);
  if (is_program) text += commands_text(*parser);
  text += options_text(command, name);
  return text + "\n" + footer_text(command.footer);
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<CLI::FormatterLambda>(help_text);
}

}  // namespace flexarm::app
