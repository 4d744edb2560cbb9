#include "measured/files/time_grid.hpp"

#include "measured/files/time_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::measured {

namespace {

/// A step above this many median steps has lost samples.
constexpr double kGap_periods = 1.5;
/// Where more than this part of the steps are so long, the times are uneven rather than lost,
constexpr double kMostGaps = 0.1;
/// unless every one of them is above this many median steps: no clock is so uneven.
constexpr double kCertainGap_periods = 10.0;

/// The lower one of an even number of values: no mean of a step and a gap.
double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> steps_of(std::span<const double> times_s) {
  std::vector<double> steps(times_s.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = times_s[i + 1] - times_s[i];
  return steps;
}

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
  const std::vector<double> steps = steps_of(times_s);
  const double period_s = lower_median(steps);
  const auto is_gap = [&](double step_s) { return step_s > kGap_periods * period_s; };
  const auto gaps = std::ranges::count_if(steps, is_gap);
  const bool are_many = static_cast<double>(gaps) > kMostGaps * static_cast<double>(steps.size());
  const bool are_certain = std::ranges::none_of(steps, [&](double step_s) {
    return is_gap(step_s) && step_s <= kCertainGap_periods * period_s;
  });
  if (gaps == 0 || (are_many && !are_certain)) return std::nullopt;
  const auto first = std::ranges::find_if(steps, is_gap);
  const auto before = static_cast<std::size_t>(first - steps.begin());
  const double missing = std::max(1.0, std::round(*first / period_s) - 1.0);
  return GridFault{
      before + 1,
      arm::InputError(fmt::format(
          "gap: {:.15g} sample{} missing between {} s and {} s, where the step is {:.6g} s and the "
          "period {:.6g} s{}; split the record there, or fill it",
          missing, missing == 1.0 ? " is" : "s are", times_s[before], times_s[before + 1], *first,
          period_s,
          gaps == 1 ? "" : fmt::format(", and {} more gap{}", gaps - 1, gaps == 2 ? "" : "s")))};
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
                            "{} or less: write more digits, or resample",
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
