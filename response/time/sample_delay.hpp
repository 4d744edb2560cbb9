#pragma once

#include <cmath>

namespace flexarm::response {

/// A fraction of a sampling period this near to 0 or 1, or to another, is the same instant:
/// delay/sample_time is rounded by no more.
inline constexpr double kSameInstant = 1e-9;

/// A delay as whole samples, below 0 where it leads, and the fraction of one, 0 or more and below 1.
struct SampleDelay {
  double samples = 0.0;
  double fraction = 0.0;
};

inline SampleDelay sample_delay(double delay_s, double sample_time_s) {
  const double delay = delay_s / sample_time_s;
  SampleDelay made{std::floor(delay), delay - std::floor(delay)};
  if (made.fraction > 1.0 - kSameInstant) made = {made.samples + 1.0, 0.0};
  if (made.fraction < kSameInstant) made.fraction = 0.0;
  return made;
}

}  // namespace flexarm::response
