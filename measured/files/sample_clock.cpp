#include "measured/files/sample_clock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::measured {

namespace {

constexpr std::size_t kGapSide = 8;     // samples on each side of a step that may be a gap
constexpr double kLongStep = 1.5;       // periods; a shorter step has lost nothing
constexpr double kShift = 0.7;          // periods by which a gap shifts what follows
constexpr std::size_t kMostLag = 16;    // samples; bursts and rounded times are shorter
constexpr std::size_t kFewestLags = 4;  // in the record
constexpr double kAlikeStep = 0.1;      // steps this close to their median, relative to it,
constexpr double kMostAlike = 0.8;      // are nearly all from this part of them on

/// The lower one of an even number of values: no mean of a step and a gap.
double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median of the positive steps over `lag` samples, for one.
double median_period(std::span<const double> times_s, std::size_t lag) {
  std::vector<double> periods;
  for (std::size_t k = lag; k < times_s.size(); ++k) {
    const double span_s = times_s[k] - times_s[k - lag];
    if (span_s > 0.0) periods.push_back(span_s / static_cast<double>(lag));
  }
  return periods.empty() ? 0.0 : lower_median(std::move(periods));
}

/// The median step where nearly all steps are alike, however many samples are lost; otherwise, in
/// bursts and rounded times, that over several samples.
double period_of(std::span<const double> times_s) {
  const double step_s = median_period(times_s, 1);
  std::size_t alike = 0;
  for (std::size_t k = 1; k < times_s.size(); ++k) {
    if (std::abs(times_s[k] - times_s[k - 1] - step_s) <= kAlikeStep * step_s) ++alike;
  }
  const auto count = static_cast<double>(times_s.size() - 1);
  if (static_cast<double>(alike) >= kMostAlike * count) return step_s;
  return median_period(times_s,
                       std::clamp((times_s.size() - 1) / kFewestLags, std::size_t{1}, kMostLag));
}

/// Median of t_j/period - j over [from, to).
double median_lead(std::span<const double> times_s, std::size_t from, std::size_t to,
                   double period_s) {
  std::vector<double> lead;
  for (std::size_t j = from; j < to; ++j) {
    lead.push_back((times_s[j] - times_s[from]) / period_s - static_cast<double>(j - from));
  }
  return times_s[from] / period_s + lower_median(std::move(lead)) - static_cast<double>(from);
}

double shift_at(std::span<const double> times_s, std::size_t k, double period_s) {
  const std::size_t from = k > kGapSide ? k - kGapSide : 0;
  const std::size_t to = std::min(times_s.size(), k + kGapSide);
  return median_lead(times_s, k, to, period_s) - median_lead(times_s, from, k, period_s);
}

}  // namespace

ClockSteps clock_steps(std::span<const double> times_s) {
  ClockSteps steps;
  steps.period_s = period_of(times_s);
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

Jitter jitter_of(std::span<const double> times_s, const ClockSteps& steps, std::size_t first,
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
  Jitter jitter;
  jitter.period_s = up / across;
  jitter.first_beyond = last;
  double earliest = 0.0;
  double latest = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    const double off =
        (times_s[k] - times_s[first] - mean_s) / jitter.period_s - (at[k - first] - mean_at);
    earliest = std::min(earliest, off);
    latest = std::max(latest, off);
    jitter.rms_periods += off * off / count;
    if (std::abs(off) > most_periods) jitter.first_beyond = std::min(jitter.first_beyond, k);
  }
  jitter.most_periods = std::max(latest, -earliest);
  jitter.range_periods = latest - earliest;
  jitter.rms_periods = std::sqrt(jitter.rms_periods);
  return jitter;
}

}  // namespace flexarm::measured
