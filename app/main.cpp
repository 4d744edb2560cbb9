#include "app/command.hpp"
#include "app/error_place.hpp"
#include "app/help_text.hpp"
#include "app/interruption.hpp"
#include "app/json_file.hpp"
#include "app/kept_inputs.hpp"
#include "app/report_choice.hpp"
#include "app/standard_output.hpp"
#include "app/suggestion.hpp"
#include "app/version.hpp"
#include "arm/input_error.hpp"
#include "report/wrapped_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace flexarm::app {

std::string example(const std::string& line) {
  constexpr std::size_t kColumns = 76;
  std::string text = "Example:\n  ";
  const auto lines = report::wrapped(line, kColumns, kColumns - 4);
  for (const auto& part : lines) {
    text += &part == &lines.front() ? part : " \\\n      " + part;
  }
  return text;
}

CLI::Validator not_empty() {
  return {[](const std::string& value) { return value.empty() ? "is empty" : std::string(); }, ""};
}

namespace {

/// Writes one line to standard error; when that fails there is nobody left to tell.
void complain(std::string_view line) {
  const std::string text = fmt::format("{}\n", line);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// The parser takes an empty value, that of a shell variable without one, for 0 or for the default.
void refuse_empty_values(CLI::App& parser) {
  for (CLI::Option* option : parser.get_options([](CLI::Option*) { return true; })) {
    if (option->get_items_expected_max() > 0) option->check(not_empty());
  }
}

/// Puts the commands under a heading of the help.
std::vector<Command> in_group(const char* heading, std::vector<Command> commands) {
  for (const auto& command : commands) command.parser->group(heading);
  return commands;
}

int run(int argc, const char* const* argv) {
  CLI::App program(
      "Models a single-link flexible manipulator in three independent formulations (exact "
      "transfer function, finite elements, assumed modes), compares them with each other and with "
      "measurements, and identifies effects that a simulation lacks.",
      "flexarm");
  program.require_subcommand(0, 1);
  program.set_version_flag("-V,--version", version_text(), "Print version, build and libraries");
  program.footer(
      "Typical session:\n"
      "  flexarm doctor                            what is installed and works\n"
      "  flexarm new rig.toml                      an arm file to edit\n"
      "  flexarm compare rig.toml                  are its poles and zeros accurate?\n"
      "  flexarm import log.csv --arm rig.toml --out bench   a log as a measurement\n"
      "  flexarm diagnose bench/measurement.toml   what does the simulation lack?\n\n"
      "Numbers: with a decimal point; a comma separates the items of a list, as in 0,0.05,0.2. "
      "What may be meant as a decimal comma, such as 0,05, is refused.\n"
      "Help: flexarm COMMAND --help describes one command.\n"
      "Exit status: 0 success; 1 failure; 2 invalid input, with one line on standard error.");
  program.formatter(help_formatter());
  const std::array commands = {
      in_group("First steps", {add_doctor(program), add_new(program), add_compare(program)}),
      in_group("One arm", {add_modes(program), add_response(program), add_simulate(program),
                           add_sweep(program), add_export(program)}),
      in_group("Measured data", {add_import(program), add_identify(program), add_diagnose(program),
                                 add_plan(program)}),
      in_group("Reference", {add_effects(program), add_paper(program), add_completion(program)}),
      std::vector{add_manual_pages(program)}};

  for (const auto& group : commands) {
    for (const auto& command : group) refuse_empty_values(*command.parser);
  }
  try {
    program.parse(argc, argv);
    for (const auto& group : commands) {
      for (const auto& command : group) {
        if (!command.parser->parsed()) continue;
        require_inputs_kept(*command.parser);
        if (const auto* json = command.parser->get_option_no_throw("--json");
            json != nullptr && json->count() > 0 && is_standard_output(json->as<std::string>())) {
          reserve_standard_output();
        }
        try {
          return command.run();
        } catch (const arm::InputError& error) {
          throw placed(error, *command.parser);
        }
      }
    }
    print(program.help());
    return kSuccess;
  } catch (const CLI::CallForHelp&) {
    print(program.help());  // of the subcommand, where one was typed
    return kSuccess;
  } catch (const CLI::CallForVersion& version) {
    print(version.what());
    return kSuccess;
  } catch (const CLI::ParseError& error) {
    complain(fmt::format("flexarm: {}", explain(program, error)));
    return kInputError;
  }
}

}  // namespace
}  // namespace flexarm::app

int main(int argc, char** argv) {
  using namespace flexarm;
  // A closed pipe shows as EPIPE, so that it ends the program where it prints and nowhere else.
  std::signal(SIGPIPE, SIG_IGN);
  app::end_at_once_when_interrupted();
  app::note_command_line(argc, argv);
  try {
    return app::run(argc, argv);
  } catch (const app::OutputClosed&) {
    return app::kOutputClosed;
  } catch (const arm::InputError& error) {
    app::complain(error.what());
    return app::kInputError;
  } catch (const std::bad_alloc&) {
    app::complain("flexarm: out of memory: ask for fewer samples, frequencies or modes");
    return app::kInputError;
  } catch (const std::system_error& error) {
    app::complain(fmt::format("flexarm: {}", error.what()));
    return app::kInputError;
  } catch (const std::exception& error) {
    app::complain(fmt::format("flexarm: {}", error.what()));
    return app::kFailure;
  }
}
