#pragma once

#include <array>
#include <atomic>
#include <csignal>

namespace flexarm::app {

inline constexpr std::array<int, 3> kEndingSignals = {SIGINT, SIGTERM, SIGHUP};

/// From here on Ctrl-C, and the signals that end a program, write one line to standard error in
/// place of a line of progress, and end the program at once, as the shell expects it. Files are
/// written whole: `measured::write_atomically` holds signals off. Called once, by the main thread.
void end_at_once_when_interrupted();

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
  std::array<struct sigaction, kEndingSignals.size()> previous_ = {};
};

}  // namespace flexarm::app
