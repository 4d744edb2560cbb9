#include "measured/files/time_grid.hpp"

#include "measured/files/sample_clock.hpp"
#include "measured/files/time_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace flexarm::measured {

namespace {

std::optional<GridFault> backward_fault(std::span<const double> times_s) {
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    if (times_s[i] > times_s[i - 1]) continue;
    const std::string how = times_s[i] == times_s[i - 1]
                                ? "same as the previous sample"
                                : fmt::format("below the previous sample at {} s", times_s[i - 1]);
    return GridFault{i, arm::InputError(fmt::format("time = {} s: {}; must be strictly increasing",
                                                    times_s[i], how))};
  }
  return std::nullopt;
}

std::optional<GridFault> gap_fault(std::span<const double> times_s) {
  const ClockSteps steps = clock_steps(times_s);
  if (steps.gaps.empty()) return std::nullopt;
  const std::size_t first = steps.gaps.front();
  const std::size_t more = steps.gaps.size() - 1;
  const double missing = steps.periods[first] - 1.0;
  return GridFault{
      first, arm::InputError(fmt::format(
                 "gap: {:.15g} sample{} missing between {} s and {} s, where the step is {:.6g} s "
                 "and the period {:.6g} s{}; split the record there, or fill it (flexarm import "
                 "does)",
                 missing, missing == 1.0 ? " is" : "s are", times_s[first - 1], times_s[first],
                 times_s[first] - times_s[first - 1], steps.period_s,
                 more == 0 ? "" : fmt::format(", and {} more gap{}", more, more == 1 ? "" : "s")))};
}

std::optional<GridFault> jitter_fault(std::span<const double> times_s) {
  const double first_s = times_s.front();
  const auto last = static_cast<double>(times_s.size() - 1);
  const double period_s = (times_s.back() - first_s) / last;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const double off_s = std::abs(times_s[i] - (first_s + static_cast<double>(i) * period_s));
    if (off_s <= kMostJitter_periods * period_s) continue;
    return GridFault{i, arm::InputError(fmt::format(
                            "time = {} s: jitter {:.2g} of the sampling period {:.6g} s; must be "
                            "{} or less: write more digits, or resample (flexarm import does)",
                            times_s[i], off_s / period_s, period_s, kMostJitter_periods))};
  }
  return std::nullopt;
}

}  // namespace

std::optional<GridFault> grid_fault(std::span<const double> times_s) {
  if (auto fault = backward_fault(times_s)) return fault;
  if (auto fault = gap_fault(times_s)) return fault;
  return jitter_fault(times_s);
}

}  // namespace flexarm::measured
