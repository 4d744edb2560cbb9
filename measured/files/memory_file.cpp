#include "measured/files/memory_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstddef>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace flexarm::measured {

namespace {

std::system_error failure(int error) {
  return {error, std::generic_category(), "a file in memory"};
}

}  // namespace

MemoryFile::MemoryFile(std::string_view content)
    : descriptor_(::memfd_create("flexarm", MFD_CLOEXEC)) {
  if (!descriptor_.is_open()) throw failure(errno);
  if (const int error = write_all(descriptor_.get(), content); error != 0) throw failure(error);
  if (::lseek(descriptor_.get(), 0, SEEK_SET) != 0) throw failure(errno);
}

std::filesystem::path MemoryFile::path() const {
  return fmt::format("/proc/self/fd/{}", descriptor_.get());
}

std::string MemoryFile::content() const {
  struct stat status = {};
  if (::fstat(descriptor_.get(), &status) != 0) throw failure(errno);
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t begin = 0;
  while (begin < bytes.size()) {
    const ssize_t read = ::pread(descriptor_.get(), bytes.data() + begin, bytes.size() - begin,
                                 static_cast<off_t>(begin));
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) throw failure(read < 0 ? errno : EIO);
    begin += static_cast<std::size_t>(read);
  }
  return bytes;
}

}  // namespace flexarm::measured
