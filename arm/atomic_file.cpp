#include "arm/atomic_file.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace flexarm::arm {

namespace {

namespace fs = std::filesystem;

InputError not_written(const fs::path& path, const std::string& reason) {
  return InputError(fmt::format("{}: cannot be written: {}", shown(path.string()), reason));
}

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

std::atomic<int> pending_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not take a lock");

/// Holds off the signals that end a program. A mask would hold them off in this thread only, and
/// libraries start threads of their own; so a handler records the signal, and the destructor
/// raises it again under the handler that was there before.
class SignalsHeldOff {
 public:
  SignalsHeldOff() {
    pending_signal = 0;
    struct sigaction record = {};
    record.sa_handler = [](int signal) { pending_signal = signal; };
    sigemptyset(&record.sa_mask);
    record.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      sigaction(kSignals[i], nullptr, &previous_[i]);
      if (previous_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &record, nullptr);
    }
  }
  ~SignalsHeldOff() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      sigaction(kSignals[i], &previous_[i], nullptr);
    }
    if (const int signal = pending_signal; signal != 0) raise(signal);
  }
  SignalsHeldOff(const SignalsHeldOff&) = delete;
  SignalsHeldOff& operator=(const SignalsHeldOff&) = delete;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> previous_ = {};
};

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }
  /// 0, or the error that closing reports (a network file system's last word).
  int close() {
    const int status = ::close(descriptor_);
    descriptor_ = -1;
    return status == 0 ? 0 : errno;
  }

 private:
  int descriptor_;
};

/// 0, or the errno of the write that failed.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// A device, a pipe or a terminal: there is nothing to replace.
void write_directly(const fs::path& path, std::string_view content) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  int error = file.is_open() ? write_all(file.get(), content) : errno;
  if (error == 0) error = file.close();
  if (error != 0) throw not_written(path, reason_of(error));
}

/// Creates and fills `temporary`; 0, or the errno of the step that failed.
int fill(const fs::path& temporary, std::string_view content, const struct stat* existing) {
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) return errno;
  if (existing != nullptr && ::fchmod(file.get(), existing->st_mode & 07777U) != 0) return errno;
  if (const int error = write_all(file.get(), content); error != 0) return error;
  if (::fsync(file.get()) != 0) return errno;
  return file.close();
}

/// Makes the rename itself durable. Some file systems cannot; the content is safe without.
void synchronise_folder(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.is_open()) ::fsync(descriptor.get());
}

/// The file that `path` leads to by symbolic links.
fs::path target_of(const fs::path& path) {
  std::error_code ignored;
  return fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

}  // namespace

void require_writable(const fs::path& path) {
  if (path.empty()) throw InputError("the name of a file is empty");
  struct stat status = {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) throw not_written(path, reason_of(errno));
  if (exists && S_ISDIR(status.st_mode)) throw not_written(path, "is a folder");
  if (!path.has_filename()) throw not_written(path, "names no file");
  // A rename asks only the folder for permission; a file that is read-only is meant to stay.
  if (exists && ::access(path.c_str(), W_OK) != 0) throw not_written(path, reason_of(errno));
  const fs::path folder = folder_of(target_of(path));
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw not_written(path, fmt::format("there is no folder {}", shown(folder.string())));
  }
}

void write_atomically(const fs::path& path, std::string_view content) {
  static std::mutex one_at_a_time;  // the handlers of signals belong to the whole program
  const std::scoped_lock lock(one_at_a_time);
  static std::atomic<unsigned> serial = 0;

  require_writable(path);
  struct stat status = {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && !S_ISREG(status.st_mode)) return write_directly(path, content);

  const fs::path target = target_of(path);
  const fs::path folder = folder_of(target);
  const fs::path temporary = folder / fmt::format(".flexarm-{}-{}", ::getpid(), serial++);

  const SignalsHeldOff held_off;
  int error = fill(temporary, content, exists ? &status : nullptr);
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    if (error != EEXIST) ::unlink(temporary.c_str());
    throw not_written(path, reason_of(error));
  }
  synchronise_folder(folder);
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) {
    throw InputError(fmt::format("{}: cannot be made: {}", shown(path.string()), error.message()));
  }
}

}  // namespace flexarm::arm
