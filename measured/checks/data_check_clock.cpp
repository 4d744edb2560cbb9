#include "measured/checks/data_check_clock.hpp"

#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

namespace {

constexpr std::size_t kSide = 8;     // samples on each side of a step that may be a gap
constexpr double kLongStep = 1.5;    // periods; a shorter step has lost nothing
constexpr double kShift = 0.7;       // periods by which a gap shifts what follows
constexpr std::size_t kFewest = 10;  // samples for a line through times

/// What follows a step, in periods of the even grid: 1, more after a gap, 0 where time goes back.
struct Steps {
  double period_s = 0.0;
  std::vector<double> periods;  ///< one a sample; the first is 0
  std::vector<std::size_t> gaps;
  std::vector<std::size_t> backward;
};

double median_step(std::span<const double> times_s) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < times_s.size(); ++k) {
    if (times_s[k] > times_s[k - 1]) steps.push_back(times_s[k] - times_s[k - 1]);
  }
  return steps.empty() ? 0.0 : median(std::move(steps));
}

/// Median of t_j/period - j over [from, to).
double median_lead(std::span<const double> times_s, std::size_t from, std::size_t to,
                   double period_s) {
  std::vector<double> lead;
  for (std::size_t j = from; j < to; ++j) {
    lead.push_back((times_s[j] - times_s[from]) / period_s - static_cast<double>(j - from));
  }
  return times_s[from] / period_s + median(std::move(lead)) - static_cast<double>(from);
}

double shift_at(std::span<const double> times_s, std::size_t k, double period_s) {
  const std::size_t from = k > kSide ? k - kSide : 0;
  const std::size_t to = std::min(times_s.size(), k + kSide);
  return median_lead(times_s, k, to, period_s) - median_lead(times_s, from, k, period_s);
}

Steps clock_steps(std::span<const double> times_s) {
  Steps steps;
  steps.period_s = median_step(times_s);
  steps.periods.assign(times_s.size(), 1.0);
  steps.periods[0] = 0.0;
  for (std::size_t k = 1; k < times_s.size(); ++k) {
    const double step_s = times_s[k] - times_s[k - 1];
    if (step_s <= 0.0) {
      steps.backward.push_back(k);
      steps.periods[k] = 0.0;
    } else if (step_s > kLongStep * steps.period_s) {
      const double shift = shift_at(times_s, k, steps.period_s);
      if (shift <= kShift) continue;
      steps.gaps.push_back(k);
      steps.periods[k] = 1.0 + std::max(1.0, std::round(shift));
    }
  }
  return steps;
}

DataFinding backward_finding(std::span<const double> times_s, const Steps& steps) {
  const std::size_t k = steps.backward.front();
  const double back_s = times_s[k - 1] - times_s[k];
  return {Fault::backward_time,
          "time",
          k,
          times_s[k],
          back_s,
          fmt::format(
              "time {} at sample {}, after {:.9g} s{}",
              back_s == 0.0 ? std::string("repeats") : fmt::format("decreases by {:.3g} s", back_s),
              k + 1, times_s[k - 1], more_places(steps.backward.size()))};
}

DataFinding gap_finding(std::span<const double> times_s, const Steps& steps) {
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

/// Jitter of the times in [first, last), between steps back.
struct Jitter {
  double most_periods = 0.0;
  double rms_periods = 0.0;
  std::size_t first_beyond = 0;  ///< the first sample off by more than allowed
};

Jitter jitter_of(std::span<const double> times_s, const Steps& steps, std::size_t first,
                 std::size_t last, double most_periods) {
  const auto count = static_cast<double>(last - first);
  std::vector<double> at(last - first, 0.0);
  for (std::size_t k = first + 1; k < last; ++k) {
    at[k - first] = at[k - first - 1] + steps.periods[k];
  }
  double mean_s = 0.0;
  for (std::size_t k = first; k < last; ++k) mean_s += (times_s[k] - times_s[first]) / count;
  double mean_at = 0.0;
  for (const double n : at) mean_at += n / count;
  double up = 0.0;
  double across = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    const double n = at[k - first] - mean_at;
    up += n * (times_s[k] - times_s[first] - mean_s);
    across += n * n;
  }
  const double period_s = up / across;
  Jitter jitter;
  jitter.first_beyond = last;
  for (std::size_t k = first; k < last; ++k) {
    const double off =
        (times_s[k] - times_s[first] - mean_s) / period_s - (at[k - first] - mean_at);
    jitter.rms_periods += off * off / count;
    jitter.most_periods = std::max(jitter.most_periods, std::abs(off));
    if (std::abs(off) > most_periods) jitter.first_beyond = std::min(jitter.first_beyond, k);
  }
  jitter.rms_periods = std::sqrt(jitter.rms_periods);
  return jitter;
}

void add_jitter(std::span<const double> times_s, const Steps& steps,
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
  const Steps steps = clock_steps(times_s);
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
