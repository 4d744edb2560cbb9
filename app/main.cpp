#include "app/command.hpp"
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
      "Models a single-link flexible manipulator in three independent ways (exact transfer\n"
      "function, finite elements, assumed modes) and compares them with each other and with\n"
      "measurements.\n",
      "flexarm");
  program.require_subcommand(0, 1);
  program.set_version_flag("-V,--version", version_text(), "Print version, build and libraries");
  program.footer(
      "A first session:\n"
      "  flexarm compare           the paper's arm by three formulations, side by side\n"
      "  flexarm new rig.toml      an arm file to edit\n"
      "  flexarm modes rig.toml    its poles, zeros, slopes and shapes\n"
      "  flexarm response rig.toml its frequency response, state space, Bode diagram\n"
      "  flexarm simulate rig.toml its response in time to a torque\n"
      "  flexarm import log.csv    a log of any program as a measurement\n"
      "  flexarm identify simulated/measurement.toml  its poles, zeros, damping and gains\n"
      "  flexarm diagnose simulated/measurement.toml  what the simulation gets wrong\n"
      "  flexarm plan rig.toml measurement-plan.toml  what an experiment could tell\n"
      "  flexarm sweep --figure 18 poles over payload, by three formulations\n"
      "  flexarm effects           what an arm file may add to an ideal arm\n"
      "  flexarm paper             the paper's equations and tables, recomputed\n"
      "\nExit status: 0 success; 1 failure; 2 input that cannot be used, with one line on\n"
      "standard error.");
  // In the order of a first session.
  const std::array commands = {add_new(program),      add_modes(program),    add_response(program),
                               add_identify(program), add_diagnose(program), add_simulate(program),
                               add_import(program),   add_plan(program),     add_compare(program),
                               add_sweep(program),    add_paper(program),    add_effects(program)};

  try {
    program.parse(argc, argv);
    for (const auto& command : commands) {
      if (command.parser->parsed()) return command.run();
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
