#pragma once

#include <string>
#include <vector>

namespace flexarm::testing_app {

/// Whether this build has a sanitizer, which slows programs about tenfold.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

/// How a program ended, and what it printed.
struct Ended {
  int status = -1;  ///< exit status; 128 + signal when a signal ended it, as a shell says
  std::string output;
  std::string errors;
};

/// Where a program's standard output goes.
enum class Output { captured, closed_pipe, full_disk };

/// Runs the program `flexarm` that this build made, with `arguments`, in `folder`, to its end.
Ended run_flexarm(const std::vector<std::string>& arguments, const std::string& folder = ".",
                  Output output = Output::captured);

/// The same, with `signal` sent as soon as the program has been blocked for a while.
Ended interrupt_flexarm(const std::vector<std::string>& arguments, int signal);

/// Returns the processor time of all programs that were run to their end [s].
double processor_s();

/// Standard output of a shell command in `folder`, empty where it does not start.
std::string shell_output(const std::string& command, const std::string& folder = ".");

}  // namespace flexarm::testing_app
