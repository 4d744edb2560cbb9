#pragma once

#include <chrono>
#include <optional>

namespace flexarm::arm {

/// When work must end with what it has; none: whenever it is done. Every loop that may take longer
/// than a second asks it.
using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// Thrown out of work that was cancelled, or whose time is over.
struct Cancelled {};

inline bool is_over(const Deadline& deadline) {
  return deadline && std::chrono::steady_clock::now() >= *deadline;
}

/// Throws Cancelled after the deadline.
inline void require_time(const Deadline& deadline) {
  if (is_over(deadline)) throw Cancelled{};
}

/// The end of the first of two pieces of work: after this part of the time that is left.
inline Deadline after_part(const Deadline& deadline, double part) {
  if (!deadline) return deadline;
  using Clock = std::chrono::steady_clock;
  const auto now = Clock::now();
  return now + std::chrono::duration_cast<Clock::duration>(part * (*deadline - now));
}
inline Deadline halfway(const Deadline& deadline) {
  return after_part(deadline, 0.5);
}

}  // namespace flexarm::arm
