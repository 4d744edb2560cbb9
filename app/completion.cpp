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
#include <vector>

namespace flexarm::app {

namespace {

struct Shell {
  std::string_view name;
  std::string (*script)(const CommandDescription&, const std::vector<CommandDescription>&);
};

constexpr std::array kShells = {Shell{"bash", bash_completion}, Shell{"zsh", zsh_completion},
                                Shell{"fish", fish_completion}};

std::string_view to_string(const Shell& shell) {
  return shell.name;
}

}  // namespace

Command add_completion(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* parser = program.add_subcommand(
      "completion", "Print the script that completes commands and options in a shell");
  parser->add_option("SHELL", *shell, "bash, zsh or fish")->required();
  parser->footer(
      "Start files:\n"
      "  bash  source <(flexarm completion bash)\n"
      "  zsh   source <(flexarm completion zsh)     after compinit\n"
      "  fish  flexarm completion fish | source\n"
      "An installed package has these scripts in place.\n\n" +
      example("flexarm completion bash"));
  return {parser, [shell, &program] {
            const Shell chosen = arm::read_word("completion", *shell, kShells);
            print(chosen.script(describe_program(program), describe_commands(program)));
            return kSuccess;
          }};
}

}  // namespace flexarm::app
