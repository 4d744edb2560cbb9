#pragma once

namespace flexarm::benchmarks {

/// How much memory the program comes to hold at most while this object lives, from the kernel's
/// high-water mark of the resident set (proc(5): /proc/self/clear_refs, VmHWM in
/// /proc/self/status). Linux and glibc.
class PeakMemory {
 public:
  PeakMemory();
  /// Bytes above what was resident at the beginning, in whole pages; NaN where the kernel does not
  /// tell.
  double bytes() const;

 private:
  double at_start_;
};

}  // namespace flexarm::benchmarks
