#include "app/command.hpp"
#include "app/completion_scripts.hpp"
#include "app/option_tree.hpp"
#include "app/standard_output.hpp"
#include "arm/read_word.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <memory>
#include <string>
#include <string_view>

namespace flexarm::app {

namespace {

enum class Shell { bash, zsh, fish };

constexpr std::array kShells = {Shell::bash, Shell::zsh, Shell::fish};

std::string_view to_string(Shell shell) {
  switch (shell) {
    case Shell::bash:
      return "bash";
    case Shell::zsh:
      return "zsh";
    case Shell::fish:
      break;
  }
  return "fish";
}

std::string script(Shell shell, const CLI::App& program) {
  const auto whole = describe_program(program);
  const auto commands = describe_commands(program);
  switch (shell) {
    case Shell::bash:
      return bash_completion(whole, commands);
    case Shell::zsh:
      return zsh_completion(whole, commands);
    case Shell::fish:
      break;
  }
  return fish_completion(whole, commands);
}

}  // namespace

Command add_completion(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* parser = program.add_subcommand(
      "completion", "Print the script that completes commands and options in a shell");
  parser->add_option("SHELL", *shell, "bash, zsh or fish")->required();
  parser->footer(
      "An installed package has these scripts in place. Otherwise, in a start file of the shell:\n"
      "  bash  source <(flexarm completion bash)\n"
      "  zsh   source <(flexarm completion zsh)     after compinit\n"
      "  fish  flexarm completion fish | source\n\n" +
      example("flexarm completion bash"));
  return {parser, [shell, &program] {
            print(script(arm::read_word("completion", *shell, kShells), program));
            return kSuccess;
          }};
}

}  // namespace flexarm::app
