#include "report/figures/gnuplot.hpp"

#include "arm/input_error.hpp"
#include "measured/files/file_writing.hpp"
#include "measured/files/memory_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace flexarm::report {
namespace {

using measured::MemoryFile;

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Waits for the child's end; returns its wait status. One that takes longer is ended.
int end_of(pid_t child, std::chrono::milliseconds longest) {
  // By its number: the header of glibc 2.36 does not declare it as C.
  const measured::Descriptor handle(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  if (!handle.is_open()) fail(errno, "pidfd_open");
  pollfd ended{handle.get(), POLLIN, 0};
  int ready = 0;
  do {
    ready = ::poll(&ended, 1, static_cast<int>(longest.count()));
  } while (ready < 0 && errno == EINTR);
  if (ready == 0) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(errno, "waitpid");
  }
  if (ready == 0) {
    throw std::runtime_error(
        fmt::format("gnuplot did not end within {} s", static_cast<double>(longest.count()) / 1e3));
  }
  return status;
}

/// The three streams are files rather than pipes, so that neither side ever waits for the other to
/// read.
pid_t started(const MemoryFile& in, const MemoryFile& out, const MemoryFile& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.descriptor(), STDERR_FILENO);
  // -d: the user's own gnuplot settings do not reach the figure.
  std::string program = "gnuplot";
  std::string defaults = "-d";
  const std::array<char*, 3> arguments{program.data(), defaults.data(), nullptr};
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) {
    throw arm::InputError(
        "figures need gnuplot, which is not on PATH (Debian package gnuplot-nox)");
  }
  if (error != 0) fail(error, "cannot start gnuplot");
  return child;
}

}  // namespace

std::string run_gnuplot(std::string_view script, std::chrono::milliseconds longest) {
  const MemoryFile in(script);
  const MemoryFile out;
  const MemoryFile err;
  const int status = end_of(started(in, out, err), longest);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(
        fmt::format("gnuplot failed (wait status {}): {}", status, err.content()));
  }
  return out.content();
}

}  // namespace flexarm::report
