#include "benchmarks/peak_memory.hpp"

#include <fstream>
#include <limits>
#include <malloc.h>
#include <string>

namespace flexarm::benchmarks {

namespace {

double high_water_mark_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0.0;
    if (word == "VmHWM:" && status >> kibibytes) return 1024.0 * kibibytes;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

PeakMemory::PeakMemory() {
  // What malloc keeps for reuse would hide the next allocations.
  malloc_trim(0);
  constexpr char kResetHighWaterMark = '5';
  const bool was_reset = static_cast<bool>(std::ofstream("/proc/self/clear_refs")
                                           << kResetHighWaterMark << std::flush);
  at_start_ = was_reset ? high_water_mark_bytes() : std::numeric_limits<double>::quiet_NaN();
}

double PeakMemory::bytes() const {
  return high_water_mark_bytes() - at_start_;
}

}  // namespace flexarm::benchmarks
