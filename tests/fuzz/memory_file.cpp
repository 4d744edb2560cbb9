#include "tests/fuzz/memory_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace flexarm::fuzz {

namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

int memory_file() {
  const int descriptor = ::memfd_create("fuzz-input", MFD_CLOEXEC);
  if (descriptor < 0) fail("memfd_create");
  return descriptor;
}

}  // namespace

std::filesystem::path file_with(std::string_view bytes) {
  static const int descriptor = memory_file();
  if (::ftruncate(descriptor, 0) != 0) fail("ftruncate");
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written =
        ::pwrite(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (written < 0) fail("pwrite");
    done += static_cast<std::size_t>(written);
  }
  return fmt::format("/proc/self/fd/{}", descriptor);
}

}  // namespace flexarm::fuzz
