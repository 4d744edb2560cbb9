#pragma once

#include "measured/files/sample_clock.hpp"

#include <optional>
#include <span>

namespace flexarm::measured {

/// The steps of a clock whose stamps jitter so much that they may change places, so that a single
/// step tells nothing of a gap: white jitter of 0.1 periods rms or more about an even grid.
///
///     t_k/period = a + k + sum_j m_j [k >= k_j] + e_k
///
/// Shifts m_j (a gap where positive, a clock set back or rows written twice where negative) are
/// added one after the other, the one that explains most first, while each explains more than 40
/// variances of e and is of 0.7 periods or more. Empty where e is not white: the clock wanders,
/// stalls or is even. `period_s` is a first estimate of the period (`clock_steps`). `periods` has
/// 1 + m_j at a gap, 0 at a step back.
std::optional<ClockSteps> jittered_steps(std::span<const double> times_s, double period_s);

}  // namespace flexarm::measured
