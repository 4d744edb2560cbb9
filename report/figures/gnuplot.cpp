#include "report/figures/gnuplot.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <spawn.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace flexarm::report {
namespace {

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// A file in memory that has no name in the file system. The child's three streams are such files
/// rather than pipes, so that neither side ever waits for the other to read.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("flexarm-gnuplot", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail(errno, "memfd_create");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  void fill(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = write(descriptor_, text.data(), text.size());
      if (written < 0) fail(errno, "write");
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    rewind();
  }

  std::string content() {
    rewind();
    std::string text;
    std::array<char, 65536> buffer{};
    ssize_t count = 0;
    while ((count = read(descriptor_, buffer.data(), buffer.size())) > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    if (count < 0) fail(errno, "read");
    return text;
  }

 private:
  void rewind() const {
    if (lseek(descriptor_, 0, SEEK_SET) != 0) fail(errno, "lseek");
  }
  int descriptor_;
};

/// Starts gnuplot on the three streams and waits for its end; returns its wait status.
int run(const MemoryFile& in, const MemoryFile& out, const MemoryFile& err) {
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

  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(errno, "waitpid");
  }
  return status;
}

}  // namespace

std::string run_gnuplot(std::string_view script) {
  MemoryFile in;
  MemoryFile out;
  MemoryFile err;
  in.fill(script);
  const int status = run(in, out, err);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(
        fmt::format("gnuplot failed (wait status {}): {}", status, err.content()));
  }
  return out.content();
}

}  // namespace flexarm::report
