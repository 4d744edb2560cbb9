#include "arm/time_limit.hpp"

#include "arm/input_error.hpp"
#include "arm/range.hpp"

namespace flexarm::arm {

namespace {

/// Limits beyond this are none: a clock counts no further.
constexpr double kLongestLimit_s = 1e9;

}  // namespace

Deadline deadline_of(const std::optional<double>& limit_s,
                     std::chrono::steady_clock::time_point begun, const OptionSpelling& spelled) {
  if (!limit_s) return std::nullopt;
  require_in_range(spelled("time-limit"), *limit_s, "s", kPositive);
  if (*limit_s > kLongestLimit_s) return std::nullopt;
  const std::chrono::duration<double> limit(*limit_s);
  return begun + std::chrono::duration_cast<std::chrono::steady_clock::duration>(limit);
}

}  // namespace flexarm::arm
