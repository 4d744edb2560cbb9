#include "app/memory_need.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sys/resource.h>
#include <unistd.h>

namespace flexarm::app {

namespace {

/// The memory of the machine, or what `ulimit -v` leaves of it [byte].
double memory_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page_bytes = ::sysconf(_SC_PAGESIZE);
  double bytes = pages > 0 && page_bytes > 0
                     ? static_cast<double>(pages) * static_cast<double>(page_bytes)
                     : HUGE_VAL;
  rlimit limit = {};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  }
  return bytes;
}

}  // namespace

void require_memory(const std::string& option, double count, double bytes) {
  constexpr double kGB = 1e9;
  const double there_bytes = memory_bytes();
  if (bytes <= there_bytes) return;
  throw arm::InputError(
      fmt::format("{} = {:.15g}: needs at least {:.3g} GB of memory; must fit into "
                  "the {:.3g} GB of this machine",
                  option, count, bytes / kGB, there_bytes / kGB));
}

}  // namespace flexarm::app
