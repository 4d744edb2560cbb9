#include "measured/files/file_writing.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <set>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace flexarm::measured {

namespace {

namespace fs = std::filesystem;

std::atomic<int> pending_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not take a lock");

constexpr std::string_view kTemporaryPrefix = ".flexarm-";

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

}  // namespace

SignalsHeldOff::SignalsHeldOff() {
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

SignalsHeldOff::~SignalsHeldOff() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &previous_[i], nullptr);
  }
  if (const int signal = pending_signal; signal != 0) raise(signal);
}

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

int Descriptor::close() {
  const int status = ::close(descriptor_);
  descriptor_ = -1;
  return status == 0 ? 0 : errno;
}

int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int create_file(const fs::path& path, std::string_view content, const struct stat* like) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) return errno;
  if (like != nullptr && ::fchmod(file.get(), like->st_mode & 07777U) != 0) return errno;
  if (const int error = write_all(file.get(), content); error != 0) return error;
  if (::fsync(file.get()) != 0) return errno;
  return file.close();
}

void synchronise_folder(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.is_open()) ::fsync(descriptor.get());
}

fs::path temporary_name(const fs::path& folder) {
  std::uint64_t number = 0;
  if (::getentropy(&number, sizeof number) != 0) {
    throw std::system_error(errno, std::generic_category(), "random numbers of the system");
  }
  return folder / fmt::format("{}{:016x}", kTemporaryPrefix, number);
}

void sweep_temporaries(const fs::path& folder) {
  constexpr auto kStale = std::chrono::hours(24);
  static std::set<fs::path> swept;  // under the lock of the writer
  std::error_code ignored;
  if (!swept.insert(fs::absolute(folder, ignored)).second) return;
  const auto begun = fs::file_time_type::clock::now() - kStale;
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (!entry->path().filename().string().starts_with(kTemporaryPrefix)) continue;
    std::error_code gone;
    const auto changed = entry->last_write_time(gone);
    if (!gone && changed < begun) stale.push_back(entry->path());
  }
  for (const fs::path& path : stale) fs::remove_all(path, ignored);
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

}  // namespace flexarm::measured
