#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// An option or a positional argument, as it was declared.
struct OptionDescription {
  std::vector<std::string> names;  ///< "-h", "--help"; of a positional argument one: "ARM"
  bool is_positional = false;
  bool is_required = false;
  bool is_list = false;        ///< one value is a comma-separated list
  bool is_repeatable = false;  ///< several values, by repetition or as a list
  std::string value;           ///< "TEXT", "FLOAT"; empty: a flag
  std::string default_value;
  std::string text;
};

/// A subcommand, or the program itself: what its help, its manual page and the completion of a
/// shell say of it.
struct CommandDescription {
  std::string name;
  std::string summary;
  std::vector<OptionDescription> options;
  std::string footer;  ///< exit status, example
};

/// What `program` itself takes.
CommandDescription describe_program(const CLI::App& program);

/// The subcommands that its help lists, in their order.
std::vector<CommandDescription> describe_commands(const CLI::App& program);

}  // namespace flexarm::app
