#include "app/option_tree.hpp"

#include "app/list_option.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

namespace {

OptionDescription describe_option(const CLI::Option& option) {
  OptionDescription description;
  description.is_positional = option.get_positional();
  if (description.is_positional) {
    description.names.push_back(option.get_name(true));
  } else {
    for (const auto& name : option.get_snames()) description.names.push_back("-" + name);
    for (const auto& name : option.get_lnames()) description.names.push_back("--" + name);
  }
  description.is_required = option.get_required();
  const bool is_flag = option.get_items_expected_max() == 0;
  if (!is_flag) {
    description.value = option.get_type_name();
    if (description.value.ends_with(',')) description.value.pop_back();
    description.is_repeatable = option.get_items_expected_max() > 1;
    description.is_list = is_list_option(option);
    description.default_value = option.get_default_str();
  }
  description.text = option.get_description();
  return description;
}

CommandDescription describe_parser(const CLI::App& parser) {
  CommandDescription description;
  description.name = parser.get_name();
  description.summary = parser.get_description();
  description.footer = parser.get_footer();
  for (const CLI::Option* option : parser.get_options()) {
    // One without a group is not described: a user has no need of it.
    if (!option->get_group().empty()) description.options.push_back(describe_option(*option));
  }
  return description;
}

}  // namespace

CommandDescription describe_program(const CLI::App& program) {
  return describe_parser(program);
}

std::vector<CommandDescription> describe_commands(const CLI::App& program) {
  std::vector<CommandDescription> commands;
  const auto is_listed = [](const CLI::App* parser) { return !parser->get_group().empty(); };
  for (const CLI::App* parser : program.get_subcommands(is_listed)) {
    commands.push_back(describe_parser(*parser));
  }
  return commands;
}

}  // namespace flexarm::app
