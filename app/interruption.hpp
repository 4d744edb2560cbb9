#pragma once

#include <array>
#include <atomic>
#include <csignal>

namespace flexarm::app {

/// While one lives, Ctrl-C and the signals that end a program set a flag, so that long work can
/// leave what it has behind; a second one ends the program at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Set once a signal came.
  const std::atomic<bool>& requested() const;

  /// Ends the program by the signal that came, as the shell expects it.
  [[noreturn]] void end_program() const;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> previous_ = {};
};

}  // namespace flexarm::app
