#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace flexarm::report {

/// Runs `gnuplot` on `script` and returns what it writes to its standard output. No shell is
/// involved and no file is left behind. Throws arm::InputError when gnuplot is not on PATH, naming
/// the Debian package that has it, and std::runtime_error when it fails, with its own message, or
/// takes longer than `longest`: a figure takes a second.
std::string run_gnuplot(std::string_view script,
                        std::chrono::milliseconds longest = std::chrono::minutes(1));

}  // namespace flexarm::report
