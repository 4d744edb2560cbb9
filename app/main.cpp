#include "app/command.hpp"
#include "app/interruption.hpp"
#include "app/json_file.hpp"
#include "app/kept_inputs.hpp"
#include "app/report_choice.hpp"
#include "app/standard_output.hpp"
#include "app/suggestion.hpp"
#include "app/version.hpp"
#include "arm/input_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

namespace flexarm::app {

std::string example(const std::string& line) {
  return fmt::format("Example:\n  {}", line);
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

int run(int argc, const char* const* argv) {
  CLI::App program(
      "Models a single-link flexible manipulator in three independent formulations (exact "
      "transfer\n"
      "function, finite elements, assumed modes), compares them with each other and with "
      "measurements,\n"
      "and identifies effects that a simulation lacks.\n",
      "flexarm");
  program.require_subcommand(0, 1);
  program.set_version_flag("-V,--version", version_text(), "Print version, build and libraries");
  program.footer(
      "Typical session:\n"
      "  flexarm compare           compare the three formulations (arm of the paper)\n"
      "  flexarm new rig.toml      write an arm file template\n"
      "  flexarm modes rig.toml    poles, zeros, hub slopes, mode shapes\n"
      "  flexarm response rig.toml frequency response, state space, Bode diagram\n"
      "  flexarm simulate rig.toml time response to a torque\n"
      "  flexarm import log.csv    convert a log file to a measurement\n"
      "  flexarm identify simulated/measurement.toml  poles, zeros, damping, gains\n"
      "  flexarm diagnose simulated/measurement.toml  effects that the simulation lacks\n"
      "  flexarm plan rig.toml measurement-plan.toml  detectability before an experiment\n"
      "  flexarm sweep --figure 18 poles over payload\n"
      "  flexarm effects           list of the effects\n"
      "  flexarm paper             check of the paper's equations and tables\n\n"
      "Numbers have a decimal point. The comma separates the items of a list: 0,0.05,0.2. What may "
      "be\nmeant as a decimal comma, such as 0,05, is refused.\n"
      "Exit status: 0 success; 1 failure; 2 invalid input, with one line on standard error.");
  // In the order of a first session.
  const std::array commands = {
      add_new(program),        add_modes(program),       add_response(program),
      add_identify(program),   add_diagnose(program),    add_simulate(program),
      add_import(program),     add_plan(program),        add_compare(program),
      add_sweep(program),      add_paper(program),       add_effects(program),
      add_completion(program), add_manual_pages(program)};

  try {
    program.parse(argc, argv);
    for (const auto& command : commands) {
      if (!command.parser->parsed()) continue;
      require_inputs_kept(*command.parser);
      if (const auto* json = command.parser->get_option_no_throw("--json");
          json != nullptr && json->count() > 0 && is_standard_output(json->as<std::string>())) {
        reserve_standard_output();
      }
      return command.run();
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
  } catch (const std::exception& error) {
    app::complain(fmt::format("flexarm: {}", error.what()));
    return app::kFailure;
  }
}
