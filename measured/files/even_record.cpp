#include "measured/files/even_record.hpp"

#include "arm/input_error.hpp"
#include "measured/files/period_changes.hpp"
#include "measured/files/record_range.hpp"
#include "measured/files/resampling.hpp"
#include "measured/files/sample_clock.hpp"
#include "measured/files/time_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

namespace flexarm::measured {

namespace {

/// Digits behind the point that times are searched for.
constexpr int kMostDigits = 7;
/// A time within this of a multiple of its last digit, relative to the digit and to the time.
constexpr double kDigitError = 1e-6;
constexpr double kRelativeDigitError = 1e-12;
/// Rounded times lie off the grid by less than this in units of their last digit, peak to peak; a
/// line by least squares need not be the best one.
constexpr double kMostRounding = 1.1;
/// A last digit above this part of the period explains lost samples as well as rounding does,
constexpr double kCoarsestDigit_periods = 0.75;
/// unless so many times repeat.
constexpr double kFewestRepeats = 0.1;
/// Where so many times repeat and are no rounded ones, whole signals would be left out.
constexpr double kMostRepeats = 0.4;
/// A last digit above so many periods is coarse,
constexpr double kCoarseDigit_periods = 2.0;
/// and must still tell the period within this, relative to it.
constexpr double kMostUncertainty = 1e-3;
/// Times of a grid that lie closer, in periods, differ by rounding.
constexpr double kSameTime_periods = 1e-6;

/// The last digit of the times, 0.001 s; empty where they have more digits than looked for.
std::optional<double> last_digit_s(std::span<const double> times_s) {
  for (int digits = 0; digits <= kMostDigits; ++digits) {
    const double per_second = std::pow(10.0, digits);
    const bool fits = std::ranges::all_of(times_s, [&](double time_s) {
      const double scaled = time_s * per_second;
      return std::abs(scaled - std::round(scaled)) <=
             kDigitError + kRelativeDigitError * std::abs(scaled);
    });
    if (fits) return 1.0 / per_second;
  }
  return std::nullopt;
}

/// Sampling periods that rounded times leave open.
struct PeriodRange {
  double least_s = 0.0;
  double most_s = 0.0;
  /// Half the range, relative to its middle.
  double uncertainty() const { return (most_s - least_s) / (most_s + least_s); }
};

/// The periods T of which all t_k - k T lie within a digit of each other, or, if there is none,
/// within `kMostRounding` digits, as with `period_s`. The spread is convex in T.
PeriodRange periods_within(std::span<const double> times_s, double period_s, double digit_s) {
  const auto spread_s = [&](double at_s) {
    double least_s = HUGE_VAL;
    double most_s = -HUGE_VAL;
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      const double off_s = times_s[k] - times_s[0] - at_s * static_cast<double>(k);
      least_s = std::min(least_s, off_s);
      most_s = std::max(most_s, off_s);
    }
    return most_s - least_s;
  };
  constexpr int kHalvings = 40;
  const double reach_s = 3.0 * digit_s / static_cast<double>(times_s.size() - 1);
  const PeriodRange all{period_s - reach_s, period_s + reach_s};
  double low_s = all.least_s;
  double high_s = all.most_s;
  for (int i = 0; i < 2 * kHalvings; ++i) {
    const double third_s = (high_s - low_s) / 3.0;
    const bool is_lower = spread_s(low_s + third_s) < spread_s(high_s - third_s);
    (is_lower ? high_s : low_s) += is_lower ? -third_s : third_s;
  }
  const double best_s = 0.5 * (low_s + high_s);
  const double exact_s = digit_s * (1.0 + kDigitError);
  const double limit_s = spread_s(best_s) <= exact_s ? exact_s : kMostRounding * digit_s;
  const auto end_of = [&](double beyond_s) {
    double within_s = best_s;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle_s = 0.5 * (within_s + beyond_s);
      (spread_s(middle_s) <= limit_s ? within_s : beyond_s) = middle_s;
    }
    return within_s;
  };
  return {end_of(all.least_s), end_of(all.most_s)};
}

/// Samples of equal times.
struct EqualTimes {
  std::size_t repeats = 0;      ///< with the time of the sample before
  std::size_t most = 1;         ///< at one time
  double share = 0.0;           ///< of the times, but the first and last, that have as many
  bool differ = false;          ///< in torque, reference or a sensor, at one time
  double largest_step_s = 0.0;  ///< between the times
};

EqualTimes equal_times(const TimeRecord& record) {
  const auto& times_s = record.time_s;
  std::vector<std::size_t> counts = {1};
  EqualTimes equal;
  for (std::size_t k = 1; k < times_s.size(); ++k) {
    if (times_s[k] != times_s[k - 1]) {
      equal.largest_step_s = std::max(equal.largest_step_s, times_s[k] - times_s[k - 1]);
      counts.push_back(1);
      continue;
    }
    ++counts.back();
    ++equal.repeats;
    const auto changes = [&](const std::vector<double>& values) {
      return !values.empty() && values[k] != values[k - 1];
    };
    equal.differ |= changes(record.torque_N_m) || changes(record.reference.values) ||
                    std::ranges::any_of(record.channels, [&](const auto& channel) {
                      return changes(channel.values);
                    });
  }
  equal.most = std::ranges::max(counts);
  if (counts.size() > 2) {
    const auto as_many = std::count(counts.begin() + 1, counts.end() - 1, equal.most);
    equal.share = static_cast<double>(as_many) / static_cast<double>(counts.size() - 2);
  }
  return equal;
}

/// Steps of one period each.
ClockSteps even_steps(std::size_t samples) {
  ClockSteps steps;
  steps.periods.assign(samples, 1.0);
  steps.periods[0] = 0.0;
  return steps;
}

std::vector<double> grid_from(double first_s, double period_s, std::size_t samples) {
  std::vector<double> times_s(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    times_s[k] = first_s + period_s * static_cast<double>(k);
  }
  return times_s;
}

/// A period that is a decimal of few digits but for rounding, as that decimal.
double without_rounding(double period_s) {
  constexpr double kRounding = 1e-12;
  const double decimal_s = std::strtod(fmt::format("{:.9e}", period_s).c_str(), nullptr);
  return std::abs(decimal_s - period_s) <= kRounding * period_s ? decimal_s : period_s;
}

/// The times a + period n_k with the places n_k of the samples on the grid, by least squares.
std::vector<double> fitted_times(std::span<const double> times_s, const ClockSteps& steps,
                                 double period_s) {
  std::vector<double> at(times_s.size(), 0.0);
  for (std::size_t k = 1; k < at.size(); ++k) at[k] = at[k - 1] + steps.periods[k];
  double first_s = 0.0;
  const auto count = static_cast<double>(times_s.size());
  for (std::size_t k = 0; k < at.size(); ++k) first_s += (times_s[k] - period_s * at[k]) / count;
  // A first time that is off by rounding alone stays what the file says.
  if (std::abs(first_s - times_s[0]) <= kSameTime_periods * period_s) first_s = times_s[0];
  std::vector<double> fitted(at.size());
  for (std::size_t k = 0; k < at.size(); ++k) fitted[k] = first_s + period_s * at[k];
  return fitted;
}

TimeRecord resampled(const TimeRecord& record, double period_s, TorqueHold hold) {
  const double first_s = record.time_s.front();
  const double last_s = record.time_s.back();
  // A last time that lies on the grid but for rounding is a sample of it.
  const double steps = std::floor((last_s - first_s) / period_s + kDigitError);
  TimeRecord even{grid_from(first_s, period_s, static_cast<std::size_t>(steps) + 1), {}, {}};
  even.torque_N_m = hold == TorqueHold::zero
                        ? held_means(record.time_s, record.torque_N_m, even.time_s, period_s)
                        : linear_values(record.time_s, record.torque_N_m, even.time_s);
  even.reference.unit = record.reference.unit;
  if (!record.reference.values.empty()) {
    even.reference.values =
        held_means(record.time_s, record.reference.values, even.time_s, period_s);
  }
  for (const auto& channel : record.channels) {
    even.channels.push_back(
        {channel.sensor, cubic_values(record.time_s, channel.values, even.time_s, period_s)});
  }
  return even;
}

/// Puts the parts of one record on even grids.
class EvenMaker {
 public:
  explicit EvenMaker(const EvenOptions& options) : options_(options) {}

  EvenRecords make(const TimeRecord& record) {
    const auto& times_s = record.time_s;
    std::vector<std::size_t> bounds = {0};
    for (std::size_t k = 1; k < times_s.size(); ++k) {
      if (times_s[k] < times_s[k - 1]) bounds.push_back(k);
    }
    if (bounds.size() > 1) {
      note(fmt::format("times go back at {} place{}, first after {} s; the record is split there",
                       bounds.size() - 1, bounds.size() == 2 ? "" : "s", times_s[bounds[1] - 1]));
    }
    bounds.push_back(times_s.size());
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
      add_part(samples_of(record, bounds[i], bounds[i + 1]));
    }
    if (out_.stretches.empty()) {
      throw arm::InputError(fmt::format("time: no stretch of {} samples or more without a gap",
                                        options_.fewest_samples));
    }
    return std::move(out_);
  }

 private:
  void note(std::string text) { out_.notes.push_back(std::move(text)); }

  /// The steps on the grid that is known, or else those of the clock.
  ClockSteps steps_of(std::span<const double> times_s) const {
    if (!options_.period_s) return clock_steps(times_s);
    ClockSteps steps = even_steps(times_s.size());
    steps.period_s = *options_.period_s;
    for (std::size_t k = 1; k < times_s.size(); ++k) {
      steps.periods[k] = std::round((times_s[k] - times_s[k - 1]) / steps.period_s);
      if (steps.periods[k] > 1.0) steps.gaps.push_back(k);
    }
    return steps;
  }

  /// A record whose times do not go back.
  void add_part(TimeRecord part) {
    if (is_too_short(part)) return;
    if (options_.period_s) {
      add_clock(part);
      return;
    }
    if (add_rounded(part)) return;
    leave_out_repeats(part);
    const auto changes = period_changes(part.time_s);
    if (changes.empty()) {
      add_clock(part);
      return;
    }
    note(fmt::format(
        "the sampling period changes at {} place{}, first after {} s; the record is "
        "split there",
        changes.size(), changes.size() == 1 ? "" : "s", part.time_s[changes.front() - 1]));
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= changes.size(); ++i) {
      const std::size_t end = i < changes.size() ? changes[i] : part.time_s.size();
      const TimeRecord block = samples_of(part, begin, end);
      if (!is_too_short(block) && !add_rounded(block)) add_clock(block);
      begin = end;
    }
  }

  /// A record of one clock: times that increase, with gaps.
  void add_clock(const TimeRecord& part) {
    const ClockSteps steps = steps_of(part.time_s);
    std::size_t first = 0;
    for (const std::size_t gap : steps.gaps) {
      const double missing = steps.periods[gap] - 1.0;
      if (missing <= static_cast<double>(options_.longest_filled_gap)) continue;
      note(fmt::format("{:.15g} samples missing between {} s and {} s; the record is split there",
                       missing, part.time_s[gap - 1], part.time_s[gap]));
      add_stretch(samples_of(part, first, gap));
      first = gap;
    }
    add_stretch(samples_of(part, first, part.time_s.size()));
  }

  bool is_too_short(const TimeRecord& part) {
    if (part.time_s.size() >= options_.fewest_samples) return false;
    if (out_.stretches.empty()) out_.has_first_sample = false;
    note(fmt::format("{} sample{} at {} s left out: a stretch has {} or more", part.time_s.size(),
                     part.time_s.size() == 1 ? "" : "s", part.time_s.front(),
                     options_.fewest_samples));
    return true;
  }

  /// Rounded times of an even grid; false for any other.
  bool add_rounded(const TimeRecord& part) {
    const auto& times_s = part.time_s;
    const auto digit_s = last_digit_s(times_s);
    if (!digit_s || times_s.back() <= times_s.front()) return false;
    const ClockSteps steps = even_steps(times_s.size());
    const Jitter jitter = jitter_of(times_s, steps, 0, times_s.size(), kMostJitter_periods);
    const EqualTimes equal = equal_times(part);
    const bool do_all_repeat = equal.most > 1 && equal.share == 1.0;
    constexpr double kOneDigit = 1.5;  // a period of half a digit makes no step of two
    constexpr double kNearlyAll = 0.9;
    const bool is_of_several =
        equal.most > 1 && equal.share >= kNearlyAll && equal.largest_step_s > kOneDigit * *digit_s;
    const bool is_copied = do_all_repeat && !equal.differ;
    const bool is_rounding = jitter.range_periods * jitter.period_s <= kMostRounding * *digit_s &&
                             !is_of_several && !is_copied &&
                             (*digit_s <= kCoarsestDigit_periods * jitter.period_s ||
                              static_cast<double>(equal.repeats) >=
                                  kFewestRepeats * static_cast<double>(times_s.size()));
    if (!is_rounding) return false;
    if (do_all_repeat) refuse_equal_times(equal, *digit_s);
    const PeriodRange range = periods_within(times_s, jitter.period_s, *digit_s);
    const double period_s = std::clamp(jitter.period_s, range.least_s, range.most_s);
    if (*digit_s > kCoarseDigit_periods * period_s && range.uncertainty() > kMostUncertainty) {
      throw arm::InputError(fmt::format(
          "time: times in steps of {} s leave any sampling period from {:.4g} s to {:.4g} s open; "
          "state it with --period, or write the times with more digits",
          *digit_s, std::max(0.0, range.least_s), range.most_s));
    }
    note(fmt::format(
        "times are rounded to {} s; replaced by an even grid of period {:.6g} s, which they tell "
        "within {:.2g} s",
        *digit_s, period_s, 0.5 * (range.most_s - range.least_s)));
    TimeRecord even = part;
    even.time_s = fitted_times(times_s, steps, period_s);
    out_.stretches.push_back(std::move(even));
    return true;
  }

  [[noreturn]] static void refuse_equal_times(const EqualTimes& equal,
                                              std::optional<double> digit_s) {
    throw arm::InputError(fmt::format(
        "time: {} {} rows, with other values in each; if the rows are of several signals or "
        "devices, write each to columns or a file of its own; if the times are rounded{}, state "
        "the sampling period with --period",
        equal.share == 1.0 ? "each time stands in" : "one time stands in up to", equal.most,
        digit_s ? fmt::format(" to {} s", *digit_s) : ""));
  }

  void leave_out_repeats(TimeRecord& part) {
    const EqualTimes equal = equal_times(part);
    const std::size_t repeats = equal.repeats;
    if (repeats == 0) return;
    const bool are_many =
        static_cast<double>(repeats) >= kMostRepeats * static_cast<double>(part.time_s.size());
    const bool is_running = part.time_s.back() > part.time_s.front();
    if (are_many && equal.differ && is_running) refuse_equal_times(equal, std::nullopt);
    note(fmt::format("{} sample{} with the time of the sample before left out", repeats,
                     repeats == 1 ? "" : "s"));
    const std::vector<double> times_s = part.time_s;
    const auto thin = [&](std::vector<double>& values) {
      std::size_t kept = 0;
      for (std::size_t k = 0; k < times_s.size(); ++k) {
        if (k == 0 || times_s[k] != times_s[k - 1]) values[kept++] = values[k];
      }
      values.resize(kept);
    };
    thin(part.time_s);
    thin(part.torque_N_m);
    for (auto& channel : part.channels) thin(channel.values);
    if (!part.reference.values.empty()) thin(part.reference.values);
  }

  /// A record without long gaps.
  void add_stretch(TimeRecord stretch) {
    if (is_too_short(stretch)) return;
    if (!grid_fault(stretch.time_s)) {
      out_.stretches.push_back(std::move(stretch));
      return;
    }
    const ClockSteps steps = steps_of(stretch.time_s);
    const Jitter jitter =
        jitter_of(stretch.time_s, steps, 0, stretch.time_s.size(), kMostJitter_periods);
    double missing = 0.0;
    for (const std::size_t gap : steps.gaps) missing += steps.periods[gap] - 1.0;
    if (missing > 0.0) {
      note(
          fmt::format("{:.15g} missing sample{} in {} gap{} filled by interpolation, the first "
                      "after {} s",
                      missing, missing == 1.0 ? "" : "s", steps.gaps.size(),
                      steps.gaps.size() == 1 ? "" : "s", stretch.time_s[steps.gaps.front() - 1]));
    }
    const bool is_jittery = missing == 0.0 || jitter.most_periods > kMostJitter_periods;
    const std::string measured =
        fmt::format("sampling jitter up to {:.2g} of the period {:.6g} s (rms {:.2g})",
                    jitter.most_periods, jitter.period_s, jitter.rms_periods);
    if (is_jittery && options_.clock == Clock::stamped) {
      note(measured +
           fmt::format(
               "; resampled to an even grid of period {:.6g} s: sensors by cubic "
               "interpolation, the torque {}{}",
               steps.period_s,
               options_.torque_hold == TorqueHold::zero ? "by its mean over each step" : "linearly",
               stretch.reference.values.empty() ? ""
                                                : ", the reference by its mean over each step"));
      out_.stretches.push_back(resampled(stretch, steps.period_s, options_.torque_hold));
      return;
    }
    if (is_jittery) note(measured + "; samples taken as even, their times replaced");
    const double period_s = without_rounding(jitter.period_s);
    stretch.time_s = fitted_times(stretch.time_s, steps, period_s);
    out_.stretches.push_back(missing > 0.0 ? resampled(stretch, period_s, options_.torque_hold)
                                           : std::move(stretch));
  }

  const EvenOptions& options_;
  EvenRecords out_;
};

}  // namespace

std::string_view to_string(Clock clock) {
  return clock == Clock::stamped ? "stamped" : "even";
}

EvenRecords make_even(const TimeRecord& record, const EvenOptions& options) {
  if (!grid_fault(record.time_s)) return {{record}, {}, true};
  return EvenMaker(options).make(record);
}

}  // namespace flexarm::measured
