#include "app/completion_scripts.hpp"

#include "app/option_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace flexarm::app {

namespace {

using Kind = OptionValues::Kind;

/// The first statement of a help text, which has room beside an option.
std::string first_statement(const std::string& text) {
  std::size_t end = text.size();
  for (const char* mark : {". ", "; ", ": ", "\n"}) end = std::min(end, text.find(mark));
  return text.substr(0, end);
}

std::string option_names(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const auto& option : command.options) {
    if (!option.is_positional) names.push_back(option.names.back());
  }
  return fmt::format("{}", fmt::join(names, " "));
}

std::string command_names(const std::vector<CommandDescription>& commands) {
  std::vector<std::string> names;
  for (const auto& command : commands) names.push_back(command.name);
  return fmt::format("{}", fmt::join(names, " "));
}

/// Those of the first positional argument; none where there is none.
OptionValues argument_values(const CommandDescription& command) {
  const auto at = std::ranges::find_if(command.options, &OptionDescription::is_positional);
  return at == command.options.end() ? OptionValues{} : values_of(*at);
}

std::string replaced(std::string text, const std::map<char, std::string>& replacements) {
  std::string result;
  for (const char c : text) {
    const auto found = replacements.find(c);
    result += found == replacements.end() ? std::string(1, c) : found->second;
  }
  return result;
}

// --- bash -------------------------------------------------------------------------------------

/// What completes a value: an assignment to `words`, or a request to the shell.
std::string bash_action(const OptionValues& values) {
  switch (values.kind) {
    case Kind::words:
      return fmt::format("words='{}'", fmt::join(values.words, " "));
    case Kind::file:
      return "compopt -o default; return";
    case Kind::folder:
      return "compopt -o dirnames; return";
    case Kind::none:
      break;
  }
  return "return";
}

// --- zsh --------------------------------------------------------------------------------------

std::string zsh_quoted(const std::string& text) {
  return replaced(text,
                  {{'\'', "'\\''"}, {'[', "\\["}, {']', "\\]"}, {':', "\\:"}, {'\\', "\\\\"}});
}

std::string zsh_action(const OptionValues& values, bool is_list) {
  switch (values.kind) {
    case Kind::words:
      return is_list ? fmt::format("_values -s , value {}", fmt::join(values.words, " "))
                     : fmt::format("({})", fmt::join(values.words, " "));
    case Kind::file:
      return "_files";
    case Kind::folder:
      return "_files -/";
    case Kind::none:
      break;
  }
  return " ";
}

std::string zsh_argument(const OptionDescription& option) {
  const std::string action = zsh_action(values_of(option), option.is_list);
  if (option.is_positional) return fmt::format("'*:{}:{}'", option.names.back(), action);
  return fmt::format("'{}{}[{}]{}'", option.is_repeatable ? "*" : "", option.names.back(),
                     zsh_quoted(first_statement(option.text)),
                     option.value.empty() ? "" : ":value:" + action);
}

std::string zsh_arguments(const CommandDescription& command) {
  std::string text;
  for (const auto& option : command.options) text += " \\\n        " + zsh_argument(option);
  return text;
}

// --- fish -------------------------------------------------------------------------------------

std::string fish_quoted(const std::string& text) {
  return replaced(text, {{'\'', "\\'"}, {'\\', "\\\\"}});
}

std::string fish_values(const OptionValues& values, bool is_list) {
  switch (values.kind) {
    case Kind::words:
      return is_list ? fmt::format(" -x -a '(__fish_append , {})'", fmt::join(values.words, " "))
                     : fmt::format(" -x -a '{}'", fmt::join(values.words, " "));
    case Kind::file:
      return " -r -F";
    case Kind::folder:
      return " -x -a '(__fish_complete_directories)'";
    case Kind::none:
      break;
  }
  return " -x";
}

std::string fish_option(const std::string& condition, const OptionDescription& option) {
  std::string line = fmt::format("complete -c flexarm -n '{}'", condition);
  for (const auto& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.value.empty()) line += fish_values(values_of(option), option.is_list);
  return fmt::format("{} -d '{}'\n", line, fish_quoted(first_statement(option.text)));
}

}  // namespace

std::string bash_completion(const CommandDescription& program,
                            const std::vector<CommandDescription>& commands) {
  std::map<std::string, std::string> actions;  // by option; it has one meaning in all commands
  for (const auto& command : commands) {
    for (const auto& option : command.options) {
      if (option.is_positional || option.value.empty()) continue;
      actions[option.names.back()] = bash_action(values_of(option));
    }
  }
  std::string values;
  for (const auto& [name, action] : actions) {
    values += fmt::format("    {}) {} ;;\n", name, action);
  }
  std::string options =
      fmt::format("      '') words='{} {}' ;;\n", command_names(commands), option_names(program));
  std::string arguments;
  for (const auto& command : commands) {
    options += fmt::format("      {}) words='{}' ;;\n", command.name, option_names(command));
    arguments +=
        fmt::format("      {}) {} ;;\n", command.name, bash_action(argument_values(command)));
  }
  return fmt::format(
      R"(# bash completion for flexarm
_flexarm() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
  local command= words= before= word i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    if [[ ${{COMP_WORDS[i]}} != -* ]]; then command=${{COMP_WORDS[i]}}; break; fi
  done
  # bash takes the = of --option=value for a word.
  if [[ $current == = ]]; then
    current=
  elif [[ $previous == = ]]; then
    previous=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  case $previous in
{}  esac
  if [[ -n $words && $current == *,* ]]; then
    before=${{current%,*}},
    current=${{current##*,}}
  elif [[ -z $words && ( $current == -* || -z $command ) ]]; then
    case $command in
{}    esac
  elif [[ -z $words ]]; then
    case $command in
{}    esac
  fi
  while IFS= read -r word; do
    COMPREPLY+=("$before$word")
  done < <(compgen -W "$words" -- "$current")
  if [[ ${{#COMPREPLY[@]}} -eq 1 && ${{COMPREPLY[0]}} == *@ ]]; then compopt -o nospace; fi
}}
complete -F _flexarm flexarm
)",
      values, options, arguments);
}

std::string zsh_completion(const CommandDescription& program,
                           const std::vector<CommandDescription>& commands) {
  std::string names;
  std::string cases;
  for (const auto& command : commands) {
    names += fmt::format("        '{}:{}'\n", command.name, zsh_quoted(command.summary));
    cases += fmt::format("        {})\n      _arguments -s{} ;;\n", command.name,
                         zsh_arguments(command));
  }
  return fmt::format(R"(#compdef flexarm
_flexarm() {{
  local context state state_descr line
  typeset -A opt_args
  _arguments -C{} \
        '1:command:->command' '*::argument:->argument' && return
  case $state in
    command)
      local -a commands
      commands=(
{}      )
      _describe -t commands 'flexarm command' commands ;;
    argument)
      case $words[1] in
{}      esac ;;
  esac
}}
# Sourced, or called as an autoloaded function.
if [[ $funcstack[1] == _flexarm ]]; then _flexarm "$@"; else compdef _flexarm flexarm; fi
)",
                     zsh_arguments(program), names, cases);
}

std::string fish_completion(const CommandDescription& program,
                            const std::vector<CommandDescription>& commands) {
  std::string text = "# fish completion for flexarm\ncomplete -c flexarm -f\n";
  for (const auto& option : program.options) text += fish_option("__fish_use_subcommand", option);
  for (const auto& command : commands) {
    text += fmt::format("complete -c flexarm -n __fish_use_subcommand -a {} -d '{}'\n",
                        command.name, fish_quoted(command.summary));
  }
  for (const auto& command : commands) {
    const std::string condition = "__fish_seen_subcommand_from " + command.name;
    const OptionValues values = argument_values(command);
    if (values.kind == Kind::file) {
      text += fmt::format("complete -c flexarm -n '{}' -F\n", condition);
    } else if (values.kind == Kind::words) {
      text += fmt::format("complete -c flexarm -n '{}' -a '{}'\n", condition,
                          fmt::join(values.words, " "));
    }
    for (const auto& option : command.options) {
      if (!option.is_positional) text += fish_option(condition, option);
    }
  }
  return text;
}

}  // namespace flexarm::app
