#include "measured/checks/data_check_clock.hpp"

#include "measured/checks/data_check_stamps.hpp"
#include "measured/files/sample_clock.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace flexarm::measured {

namespace {

constexpr std::size_t kSide = 8;     // samples next to a step back that may have changed places
constexpr std::size_t kFewest = 10;  // samples for a line through times

DataFinding backward_finding(std::span<const double> times_s, const ClockSteps& steps) {
  const std::size_t k = steps.backward.front();
  const double back_s = times_s[k - 1] - times_s[k];
  std::string what = fmt::format("decreases by {:.3g} s", back_s);
  if (back_s == 0.0) what = "repeats";
  // Beside jitter, which may hide it in this one step.
  if (back_s < 0.0) what = "falls back";
  return {Fault::backward_time,
          "time",
          k,
          times_s[k],
          back_s,
          fmt::format("time {} at sample {}, after {:.9g} s{}", what, k + 1, times_s[k - 1],
                      more_places(steps.backward.size()))};
}

DataFinding gap_finding(std::span<const double> times_s, const ClockSteps& steps) {
  const std::size_t k = steps.gaps.front();
  double lost = 0.0;
  for (const std::size_t gap : steps.gaps) lost += steps.periods[gap] - 1.0;
  return {
      Fault::missing_samples,
      "time",
      k,
      times_s[k],
      lost,
      fmt::format("{:.0f} sample{} missing between {:.9g} s and {:.9g} s, where the period is "
                  "{:.6g} s{}",
                  steps.periods[k] - 1.0, steps.periods[k] == 2.0 ? " is" : "s are", times_s[k - 1],
                  times_s[k], steps.period_s,
                  steps.gaps.size() == 1 ? ""
                                         : fmt::format(", and at {} other place{}: {:.0f} in total",
                                                       steps.gaps.size() - 1,
                                                       steps.gaps.size() == 2 ? "" : "s", lost))};
}

void add_jitter(std::span<const double> times_s, const ClockSteps& steps,
                const DataCheckOptions& options, std::vector<DataFinding>& findings) {
  std::vector<std::size_t> bounds = {0};
  bounds.insert(bounds.end(), steps.backward.begin(), steps.backward.end());
  bounds.push_back(times_s.size());
  Jitter worst;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    // Next to a step back rows may have changed places.
    const std::size_t first = bounds[i] + (i == 0 ? 0 : kSide);
    const std::size_t last = bounds[i + 1] - (i + 2 == bounds.size() ? 0 : kSide);
    if (bounds[i + 1] - bounds[i] < kFewest + 2 * kSide) continue;
    const Jitter jitter = jitter_of(times_s, steps, first, last, options.most_jitter_periods);
    if (jitter.most_periods > worst.most_periods) worst = jitter;
  }
  if (worst.most_periods <= options.most_jitter_periods) return;
  const std::size_t k = worst.first_beyond;
  findings.push_back(
      {Fault::clock_jitter, "time", k, times_s[k], worst.rms_periods * steps.period_s,
       fmt::format(
           "sampling jitter up to {:.2g} of the period {:.6g} s (rms {:.2g}), first at sample {}",
           worst.most_periods, steps.period_s, worst.rms_periods, k + 1)});
}

}  // namespace

ClockCheck check_clock(std::span<const double> times_s, const DataCheckOptions& options) {
  ClockCheck check;
  ClockSteps steps = clock_steps(times_s);
  if (auto jittered = jittered_steps(times_s, steps.period_s)) steps = *std::move(jittered);
  check.period_s = steps.period_s;
  if (steps.period_s > 0.0) add_jitter(times_s, steps, options, check.findings);
  if (!steps.gaps.empty()) check.findings.push_back(gap_finding(times_s, steps));
  if (!steps.backward.empty()) check.findings.push_back(backward_finding(times_s, steps));

  std::vector<std::size_t> bounds = {0};
  std::ranges::merge(steps.gaps, steps.backward, std::back_inserter(bounds));
  bounds.push_back(times_s.size());
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    if (bounds[i + 1] - bounds[i] <= check.count) continue;
    check.first = bounds[i];
    check.count = bounds[i + 1] - bounds[i];
  }
  if (check.count > 1) {
    check.period_s = (times_s[check.first + check.count - 1] - times_s[check.first]) /
                     static_cast<double>(check.count - 1);
  }
  return check;
}

}  // namespace flexarm::measured
