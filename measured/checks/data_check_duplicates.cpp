#include "measured/checks/data_check_duplicates.hpp"

#include "measured/checks/data_check_values.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::measured {

namespace {

constexpr std::size_t kLongestBlock = 64;  // rows
constexpr std::size_t kSurroundings = 64;  // samples on either side
constexpr double kMostByChance = 1e-3;     // of the blocks of a length
/// Density of equal readings of white noise of deviation 1: 1/(2 sqrt(pi)).
constexpr double kDensity = 1.0 / 3.5449;

/// `count` rows from `first` on are those right before them.
struct RepeatedBlock {
  std::size_t first = 0;
  std::size_t count = 0;
};

bool is_repeated(std::span<const CheckedSignal> signals, std::size_t k, std::size_t lag) {
  return std::ranges::all_of(signals, [&](const CheckedSignal& signal) {
    return signal.values[k] == signal.values[k - lag];
  });
}

/// Blocks by their length, then in order.
std::vector<RepeatedBlock> repeated_blocks(std::span<const CheckedSignal> signals) {
  const std::size_t samples = signals.front().values.size();
  std::vector<RepeatedBlock> blocks;
  for (std::size_t lag = 1; lag <= kLongestBlock && 2 * lag < samples; ++lag) {
    std::size_t run = 0;
    for (std::size_t k = lag; k <= samples; ++k) {
      if (k < samples && is_repeated(signals, k, lag)) {
        ++run;
        continue;
      }
      const RepeatedBlock block{k - run, lag};
      const bool rests = lag > 1 && run >= lag && is_repeated(signals, block.first + 1, 1);
      if (run >= lag && run < 2 * lag && !rests) blocks.push_back(block);
      run = 0;
    }
  }
  return blocks;
}

/// The smallest difference between two readings: no smaller than the step that they are read in.
double smallest_gap(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k] > sorted[k - 1]) gap = std::min(gap, sorted[k] - sorted[k - 1]);
  }
  return gap;
}

bool may_rest(const CheckedSignal& signal, const RepeatedBlock& block) {
  if (signal.is(arm::SensorKind::hub_velocity)) return signal.values[block.first] == 0.0;
  return signal.is(arm::SensorKind::hub_angle) && block.count == 1 &&
         is_restful(signal.values, {block.first - 1, 2});
}

/// Probability that a signal repeats a reading of the block by chance; 1 where it may rest.
double chance_of_repeat(std::span<const CheckedSignal> signals, const CheckedSignal& signal,
                        const RepeatedBlock& block, double step) {
  if (may_rest(signal, block)) return 1.0;
  const auto x = signal.values;
  const std::size_t reach = kSurroundings + 2 * block.count;
  const std::size_t from = block.first > reach ? block.first - reach : block.count;
  const std::size_t to = std::min(x.size(), block.first + reach);
  std::size_t repeats = 0;
  for (std::size_t k = from; k < to; ++k) {
    if (x[k] == x[k - block.count] && !is_repeated(signals, k, block.count)) ++repeats;
  }
  const std::size_t first = from > 2 ? from - 2 : 0;
  const double noise = reading_noise(x.subspan(first, to - first));
  if (noise <= 0.0) return 1.0;
  return std::min(1.0, std::max(kDensity * step / noise,
                                static_cast<double>(repeats) / static_cast<double>(to - from)));
}

}  // namespace

Duplicates check_duplicates(std::span<const CheckedSignal> signals) {
  const auto candidates = repeated_blocks(signals);
  if (candidates.empty()) return {};
  const std::size_t samples = signals.front().values.size();
  std::vector<double> steps;
  for (const auto& signal : signals) steps.push_back(smallest_gap(signal.values));

  Duplicates found;
  std::size_t places = 0;
  std::vector<bool> is_copy(samples, false);
  for (const RepeatedBlock& block : candidates) {
    const auto alike = std::ranges::count(candidates, block.count, &RepeatedBlock::count);
    double log_chance = std::log(static_cast<double>(samples) / static_cast<double>(alike));
    for (std::size_t i = 0; i < signals.size(); ++i) {
      log_chance += static_cast<double>(block.count) *
                    std::log(chance_of_repeat(signals, signals[i], block, steps[i]));
    }
    const auto first = is_copy.begin() + static_cast<std::ptrdiff_t>(block.first);
    const auto last = first + static_cast<std::ptrdiff_t>(block.count);
    if (log_chance > std::log(kMostByChance) || std::find(first, last, true) != last) continue;
    std::fill(first, last, true);
    ++places;
  }
  for (std::size_t k = 0; k < samples; ++k) {
    if (is_copy[k]) found.rows.push_back(k);
  }
  if (places == 0) return found;
  const std::size_t rows = found.rows.size();
  found.findings.push_back(
      {Fault::duplicated_samples, "time", found.rows.front(), 0.0, static_cast<double>(rows),
       fmt::format(
           "{} written twice, first at sample {}{}: all columns repeat while the time goes "
           "on, so that what follows is late by as many periods",
           rows == 1 ? "1 row is" : fmt::format("{} rows are", rows), found.rows.front() + 1,
           places == 1
               ? ""
               : fmt::format(", and at {} more place{}", places - 1, places == 2 ? "" : "s"))});
  return found;
}

ShortenedSignals::ShortenedSignals(std::span<const CheckedSignal> signals,
                                   const std::vector<std::size_t>& rows) {
  for (std::size_t k = 0; k < signals.front().values.size(); ++k) {
    if (!std::ranges::binary_search(rows, k)) sample_of_.push_back(k);
  }
  for (const auto& signal : signals) {
    std::vector<double>& kept = values_.emplace_back();
    for (const std::size_t k : sample_of_) kept.push_back(signal.values[k]);
  }
  for (std::size_t i = 0; i < signals.size(); ++i) {
    signals_.push_back(
        {signals[i].name, signals[i].sensor, values_[i], standard_deviation(values_[i])});
  }
}

}  // namespace flexarm::measured
