#pragma once

#include "tests/environment_variable.hpp"

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>

namespace flexarm::report {

/// What was written into the far end of `descriptor`, which need not have ended.
inline std::string read_all(int descriptor) {
  fcntl(descriptor, F_SETFL, O_NONBLOCK);
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = ::read(descriptor, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return text;
}

/// A terminal of the test's own, with a number of columns; 0: it does not know its size. TERM is
/// that of a terminal that takes escape sequences.
class PseudoTerminal {
 public:
  explicit PseudoTerminal(unsigned short columns = 80) : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
    slave_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
    winsize size{};
    size.ws_col = columns;
    ioctl(slave_, TIOCSWINSZ, &size);
  }
  ~PseudoTerminal() {
    close(slave_);
    close(master_);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  int descriptor() const { return slave_; }
  std::string output() const { return read_all(master_); }

 private:
  int master_;
  int slave_ = -1;
  testing_environment::EnvironmentVariable kind_{"TERM", "xterm"};
};

}  // namespace flexarm::report
