#include "measured/checks/data_check_values.hpp"

#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace flexarm::measured {

namespace {

/// A signal read in steps stays at its last value for long, and flickers about it with noise: only
/// a fall of this many steps at once says that it was clipped.
constexpr double kFall_steps = 2.0;
/// A commanded torque with fewer values than this is made of levels: it holds its largest by
/// design.
constexpr std::size_t kFewestTorqueLevels = 20;

std::string_view unit_shown(const CheckedSignal& signal) {
  return signal.sensor ? arm::unit(*signal.sensor) : "N m";
}

/// Whether changes fade into a run, `at(1)` the nearest: in friction a hub comes to rest on a
/// parabola, with changes 1/2, 3/2, 5/2, ... of one size. Noise and clipping show no such row.
/// `rounding` is the step in which values are written: a change is off by as much. Four changes of
/// a few steps are those of a hub that creeps.
template <class Change>
bool fades(const Change& at, double rounding) {
  constexpr double kCreep = 4.0;  // steps
  const double largest =
      std::max({std::abs(at(1)), std::abs(at(2)), std::abs(at(3)), std::abs(at(4))});
  if (largest <= kCreep * rounding) return true;
  const auto smaller = [&](std::size_t near, std::size_t far, double factor) {
    return std::abs(at(near)) <= factor * std::abs(at(far)) + (1.0 + factor) * rounding;
  };
  const auto alike = [&](std::size_t near, std::size_t far) {
    const double product = at(near) * at(far);
    return product > 0.0 || std::abs(product) <= rounding * rounding;
  };
  return (at(1) * at(2) >= 0.0 || alike(1, 2)) && alike(2, 3) && alike(3, 4) &&
         smaller(1, 2, 0.5) && smaller(2, 3, 0.75) && smaller(3, 4, 0.9);
}

std::size_t distinct_values(std::span<const double> x) {
  std::vector<double> sorted(x.begin(), x.end());
  std::ranges::sort(sorted);
  return static_cast<std::size_t>(std::ranges::unique(sorted).begin() - sorted.begin());
}

bool varies(const CheckedSignal& signal) {
  return std::ranges::adjacent_find(signal.values, std::not_equal_to<>()) != signal.values.end();
}

std::optional<DataFinding> constant(const CheckedSignal& signal,
                                    std::span<const CheckedSignal> signals) {
  if (signal.is_torque() || varies(signal)) return std::nullopt;
  const bool others_respond = std::ranges::any_of(
      signals, [&](const CheckedSignal& other) { return !other.is_torque() && varies(other); });
  // One sensor alone may be at rest, held by friction: then it shows its zero.
  const bool alone = signals.size() == 2 && signal.values[0] != 0.0 && varies(signals[0]);
  if (!others_respond && !alone) return std::nullopt;
  return DataFinding{
      Fault::dead_channel,
      signal.name,
      0,
      0.0,
      signal.values[0],
      fmt::format("{} constant at {:.6g} {}, while {} varies", signal.name, signal.values[0],
                  unit_shown(signal), alone ? "the torque" : "another channel")};
}

/// What lies at one end of a channel's range.
struct Limit {
  std::size_t samples = 0;  ///< in runs
  std::size_t runs = 0;
  std::size_t first = 0;
};

bool falls_off(std::span<const double> x, const EqualRun& run, double least) {
  const std::size_t after = run.first + run.count;
  const bool before = run.first == 0 || std::abs(x[run.first] - x[run.first - 1]) > least;
  return before && (after >= x.size() || std::abs(x[after] - x[run.first]) > least);
}

/// Whether friction holds the hub: its velocity is next to zero; where that is not measured, its
/// angle comes to rest and leaves it by changes that shrink and grow, or stays to the end.
bool is_held(std::span<const CheckedSignal> signals, const CheckedSignal& signal,
             const EqualRun& run) {
  constexpr double kNextToZero = 1e-3;  // standard deviations of the velocity; noise is more
  if (!signal.is(arm::SensorKind::hub_angle) || run.count < 3) return false;
  const auto velocity = std::ranges::find_if(
      signals, [](const CheckedSignal& other) { return other.is(arm::SensorKind::hub_velocity); });
  if (velocity != signals.end()) {
    // The torque may tear the hub loose at the last of the samples.
    const auto inner = velocity->values.subspan(run.first + 1, run.count - 2);
    return std::ranges::all_of(
        inner, [&](double value) { return std::abs(value) <= kNextToZero * velocity->deviation; });
  }
  const auto x = signal.values;
  const std::size_t last = run.first + run.count - 1;
  if (last + 1 == x.size()) return true;
  const auto shrinks = [](double near, double far) {
    return near * far >= 0.0 && std::abs(near) <= 0.75 * std::abs(far);
  };
  const bool stops = run.first < 2 ||
                     shrinks(x[run.first] - x[run.first - 1], x[run.first - 1] - x[run.first - 2]);
  const bool starts =
      last + 2 >= x.size() || shrinks(x[last + 1] - x[last], x[last + 2] - x[last + 1]);
  return stops && starts;
}

/// Whether a value that was held jumps to where the signal has got in the meantime: it was stuck.
/// What is clipped goes on from its limit.
bool catches_up(std::span<const double> x, const EqualRun& run) {
  constexpr std::size_t kNext = 4;
  constexpr double kJump = 4.0;
  const std::size_t after = run.first + run.count;
  if (run.count <= kNext || after + kNext >= x.size()) return false;
  double usual = 0.0;
  for (std::size_t k = after; k < after + kNext; ++k) {
    usual = std::max(usual, std::abs(x[k + 1] - x[k]));
  }
  return std::abs(x[after] - x[run.first]) > kJump * usual;
}

/// The smallest change from one sample to the next: what a reading in fine steps turns back by,
/// where a hub rests between moves.
double smallest_change(std::span<const double> x) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < x.size(); ++k) {
    const double change = std::abs(x[k] - x[k - 1]);
    if (change > 0.0) smallest = std::min(smallest, change);
  }
  return smallest;
}

/// What lies beside a run: readings of seven digits have finer steps elsewhere.
std::span<const double> around(std::span<const double> x, const EqualRun& run) {
  constexpr std::size_t kBeside = 64;  // samples
  const std::size_t from = run.first - std::min(run.first, kBeside);
  return x.subspan(from, std::min(x.size(), run.first + run.count + kBeside) - from);
}

Limit limit_at(std::span<const CheckedSignal> signals, const CheckedSignal& signal, double value,
               double step) {
  const auto x = signal.values;
  const double least_fall = kFall_steps * std::max(step, smallest_change(x));
  Limit limit;
  // Readings in steps repeat their largest value, and a torque that repeats itself does; others
  // never do unless they are clipped.
  for (const auto& run : equal_runs(x, step > 0.0 || signal.is_torque() ? 2 : 1)) {
    if (x[run.first] != value || catches_up(x, run) || is_held(signals, signal, run) ||
        is_restful(x, run) || !falls_off(x, run, least_fall)) {
      continue;
    }
    if (limit.runs == 0) limit.first = run.first;
    limit.samples += run.count;
    ++limit.runs;
  }
  return limit;
}

std::optional<DataFinding> saturation(const CheckedSignal& signal,
                                      std::span<const CheckedSignal> signals, double step,
                                      const DataCheckOptions& options) {
  const auto x = signal.values;
  if (signal.is_torque() && has_few_levels(x)) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(x);
  std::optional<DataFinding> found;
  std::size_t samples = 0;
  for (const double value : {low, high}) {
    if (value == 0.0) continue;  // where a sensor rests
    const Limit limit = limit_at(signals, signal, value, step);
    // A torque that repeats itself has an arm without noise repeat its peaks, single samples.
    const bool is_in_runs = limit.samples > limit.runs;
    if (limit.samples < static_cast<std::size_t>(options.least_clipped_samples) || !is_in_runs) {
      continue;
    }
    samples += limit.samples;
    const bool first = !found || limit.first < found->first_sample;
    const std::string bounds =
        found ? fmt::format("{:.6g} and {:.6g}", low, high) : fmt::format("{:.6g}", value);
    const std::size_t at = first ? limit.first : found->first_sample;
    found = DataFinding{Fault::saturation,
                        signal.name,
                        at,
                        0.0,
                        first ? value : found->value,
                        fmt::format("{} saturates at {} {}: {} samples, first at sample {}",
                                    signal.name, bounds, unit_shown(signal), samples, at + 1)};
  }
  return found;
}

bool another_moves(std::span<const CheckedSignal> signals, const CheckedSignal& self,
                   const EqualRun& run) {
  return std::ranges::any_of(signals, [&](const CheckedSignal& other) {
    if (other.name == self.name) return false;
    const auto part = other.values.subspan(run.first, run.count);
    std::size_t moves = 0;
    for (std::size_t k = 1; k < part.size(); ++k) moves += part[k] != part[k - 1] ? 1U : 0U;
    return 2 * moves >= run.count;
  });
}

/// Whether so many equal values are more than the steps of the readings explain.
bool is_long(const EqualRun& run, std::span<const double> x, std::span<const EqualRun> pairs,
             double step) {
  std::vector<double> others;
  for (const auto& pair : pairs) {
    if (pair.first != run.first) others.push_back(static_cast<double>(pair.count));
  }
  if (others.empty()) return true;
  if (static_cast<double>(run.count) < 4.0 * quantile(std::move(others), 0.95)) return false;
  if (step == 0.0) return true;
  const std::size_t after = run.first + run.count;
  return after < x.size() && std::abs(x[after] - x[run.first]) > kFall_steps * step;
}

std::optional<DataFinding> stuck(const CheckedSignal& signal,
                                 std::span<const CheckedSignal> signals, double step,
                                 const DataCheckOptions& options) {
  if (signal.is_torque()) return std::nullopt;
  const auto x = signal.values;
  const auto pairs = equal_runs(x, 2);
  std::optional<DataFinding> found;
  std::size_t places = 0;
  EqualRun first_run;
  for (const auto& run : pairs) {
    if (run.count < static_cast<std::size_t>(options.least_stuck_samples)) continue;
    const bool rests_at_zero =
        x[run.first] == 0.0 && (run.first == 0 || signal.is(arm::SensorKind::hub_velocity));
    // A hub that friction stops creeps by the last digit.
    const double rounding =
        signal.is(arm::SensorKind::hub_angle) ? smallest_change(around(x, run)) : 0.0;
    // What goes on from its first reading without a jump has not begun to move, or shows it late.
    const bool begins = run.first == 0 && !catches_up(x, run);
    if (rests_at_zero || begins || is_restful(x, run, rounding) || is_held(signals, signal, run) ||
        !another_moves(signals, signal, run) || !is_long(run, x, pairs, step)) {
      continue;
    }
    if (places++ == 0) first_run = run;
  }
  if (places == 0) return std::nullopt;
  return DataFinding{
      Fault::stuck_values,
      signal.name,
      first_run.first,
      0.0,
      static_cast<double>(first_run.count),
      fmt::format("{} stuck at {:.6g} {} for {} samples from sample {}, while others vary{}",
                  signal.name, x[first_run.first], unit_shown(signal), first_run.count,
                  first_run.first + 1, more_places(places))};
}

}  // namespace

bool has_few_levels(std::span<const double> torque) {
  return distinct_values(torque) < kFewestTorqueLevels;
}

bool is_restful(std::span<const double> x, const EqualRun& run, double rounding) {
  constexpr std::size_t kChanges = 4;
  const std::size_t last = run.first + run.count - 1;
  const bool fades_in =
      run.first < kChanges ||
      fades([&](std::size_t j) { return x[run.first - j + 1] - x[run.first - j]; }, rounding);
  const bool fades_out =
      last + kChanges >= x.size() ||
      fades([&](std::size_t j) { return x[last + j] - x[last + j - 1]; }, rounding);
  return fades_in && fades_out;
}

std::vector<DataFinding> check_values(std::span<const CheckedSignal> signals,
                                      const DataCheckOptions& options) {
  std::vector<DataFinding> findings;
  const auto& torque = signals[0];
  const bool is_zero =
      std::ranges::all_of(torque.values, [](double value) { return value == 0.0; });
  // An arm that was released moves without a torque.
  if (is_zero && options.starts_at_rest) {
    findings.push_back(
        {Fault::zero_torque, torque.name, 0, 0.0, 0.0,
         "torque is zero at all samples: the actual input is unknown; of an arm that was "
         "released or struck, state initial = \"free\""});
  }
  for (const auto& signal : signals) {
    const double step =
        lattice_step(signal.values, options.fine_step * signal.deviation).value_or(0.0);
    auto found = constant(signal, signals);
    if (!found) found = saturation(signal, signals, step, options);
    if (!found) found = stuck(signal, signals, step, options);
    if (found) findings.push_back(*found);
  }
  return findings;
}

std::vector<DataFinding> check_quantisation(std::span<const CheckedSignal> signals,
                                            std::span<const double> floor_power,
                                            const DataCheckOptions& options) {
  std::vector<DataFinding> findings;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const auto& signal = signals[i];
    if (signal.is_torque() && has_few_levels(signal.values)) continue;
    const auto step = lattice_step(signal.values, options.fine_step * signal.deviation);
    if (!step) continue;
    const double error_power = *step * *step / 12.0;
    if (*step < options.coarse_step * signal.deviation &&
        error_power < options.floor_share * floor_power[i]) {
      continue;
    }
    findings.push_back(
        {Fault::quantisation, signal.name, 0, 0.0, *step,
         fmt::format("{}: quantisation step {:.4g} {} ({:.2g} of its standard deviation); "
                     "quantisation error {:.2g} {} rms, {:.2g} of the noise floor",
                     signal.name, *step, unit_shown(signal), *step / signal.deviation,
                     std::sqrt(error_power), unit_shown(signal),
                     std::sqrt(error_power / std::max(floor_power[i], 1e-300)))});
  }
  return findings;
}

}  // namespace flexarm::measured
