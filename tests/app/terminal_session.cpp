#include "tests/app/terminal_session.hpp"

#include <array>
#include <cstdlib>
#include <poll.h>
#include <pty.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace flexarm::testing_app {

namespace {

/// Far longer than a line of progress waits [ms].
constexpr int kAtWork_ms = 20'000;
constexpr char kCtrlC = '\x03';

struct OpenTerminal {
  pid_t child = -1;
  int terminal = -1;
};

OpenTerminal start_session(const std::vector<std::string>& arguments, unsigned short columns,
                           const std::map<std::string, std::string>& environment) {
  std::vector<std::string> words = {FLEXARM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  winsize size{};
  size.ws_row = 24;
  size.ws_col = columns;
  OpenTerminal session;
  session.child = ::forkpty(&session.terminal, nullptr, nullptr, &size);
  if (session.child < 0) throw std::runtime_error("no terminal");
  if (session.child == 0) {
    for (const char* variable : {"COLUMNS", "NO_COLOR"}) ::unsetenv(variable);
    ::setenv("TERM", "xterm", 1);
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  return session;
}

Ended finish_session(const OpenTerminal& session) {
  std::string output;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = ::read(session.terminal, part.data(), part.size())) > 0;) {
    output.append(part.data(), static_cast<std::size_t>(count));
  }
  ::close(session.terminal);
  int status = 0;
  ::waitpid(session.child, &status, 0);
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), output, ""};
}

}  // namespace

Ended run_on_terminal(const std::vector<std::string>& arguments, unsigned short columns,
                      const std::map<std::string, std::string>& environment) {
  return finish_session(start_session(arguments, columns, environment));
}

Ended interrupt_on_terminal(const std::vector<std::string>& arguments, unsigned short columns) {
  const OpenTerminal session = start_session(arguments, columns, {});
  pollfd progress = {session.terminal, POLLIN, 0};
  ::poll(&progress, 1, kAtWork_ms);
  [[maybe_unused]] const ssize_t typed = ::write(session.terminal, &kCtrlC, 1);
  return finish_session(session);
}

}  // namespace flexarm::testing_app
