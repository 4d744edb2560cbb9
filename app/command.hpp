#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace flexarm::app {

/// Exit statuses of the program; 1 is also a comparison that disagrees.
inline constexpr int kSuccess = 0;
inline constexpr int kFailure = 1;
inline constexpr int kInputError = 2;
inline constexpr int kOutputClosed = 141;  // as a shell reports an end by SIGPIPE

/// One subcommand of `flexarm`. Each file app/NAME.cpp declares its options and what it does in
/// one function, `Command add_NAME(CLI::App& program)`; app/main.cpp lists them.
struct Command {
  CLI::App* parser = nullptr;
  /// Does the work when `parser` was the subcommand typed, and returns the exit status. Throws
  /// arm::InputError for input that cannot be used.
  std::function<int()> run;
};

/// The text under a command's options: an example line that works as it stands.
std::string example(const std::string& line);

/// Refuses an empty value, such as a script's variable that was never set.
CLI::Validator not_empty();

Command add_compare(CLI::App& program);
Command add_completion(CLI::App& program);
Command add_diagnose(CLI::App& program);
Command add_doctor(CLI::App& program);
Command add_effects(CLI::App& program);
Command add_export(CLI::App& program);
Command add_identify(CLI::App& program);
Command add_import(CLI::App& program);
Command add_manual_pages(CLI::App& program);
Command add_modes(CLI::App& program);
Command add_new(CLI::App& program);
Command add_paper(CLI::App& program);
Command add_plan(CLI::App& program);
Command add_response(CLI::App& program);
Command add_simulate(CLI::App& program);
Command add_sweep(CLI::App& program);

}  // namespace flexarm::app
