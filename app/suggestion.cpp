#include "app/suggestion.hpp"

#include "arm/decimal_comma.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace flexarm::app {

namespace {

std::vector<std::string> subcommands_of(const CLI::App& parser) {
  std::vector<std::string> names;
  for (const auto* command : parser.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> options_of(const CLI::App& parser) {
  std::vector<std::string> names;
  for (const auto* option : parser.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  const CLI::App& parser = chosen.empty() ? program : *chosen.front();
  const std::string help =
      chosen.empty() ? "flexarm --help" : fmt::format("flexarm {} --help", parser.get_name());

  const auto extras = program.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || extras.empty()) {
    // Some of the library's messages run over several lines.
    std::string what = error.what();
    std::ranges::replace(what, '\n', ' ');
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
      what += arm::decimal_comma_hint(what.substr(what.rfind(' ') + 1));
    }
    return fmt::format("{}; see {}", what, help);
  }
  // "--name=value" was meant as "--name".
  const std::string typed = extras.front().substr(0, extras.front().find('='));
  const bool is_option = typed.starts_with('-');
  const bool is_command = !is_option && chosen.empty();
  const auto names = is_option ? options_of(parser) : subcommands_of(program);
  return fmt::format("{}: unknown {}{}; see {}", arm::shown(typed),
                     is_option    ? "option"
                     : is_command ? "command"
                                  : "argument",
                     is_option || is_command ? arm::did_you_mean(typed, names) : "", help);
}

}  // namespace flexarm::app
