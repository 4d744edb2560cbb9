#include "measured/files/period_changes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::measured {

namespace {

constexpr std::size_t kWindow = 8;          ///< steps whose median tells a period
constexpr std::size_t kFewestInBlock = 10;  ///< samples
constexpr double kFewestInBlocks = 0.9;     ///< of all samples
constexpr double kFewestAlike = 0.8;        ///< of the steps of a block
constexpr double kBurstError_periods = 1.5;

/// Samples [first, last) of one period.
struct PeriodBlock {
  std::size_t first = 0;
  std::size_t last = 0;
  double period_s = 0.0;
};

/// The step that leads to sample k.
double step_to(std::span<const double> times_s, std::size_t k) {
  return times_s[k] - times_s[k - 1];
}

/// The lower median of the steps to the samples [first, last), one or more.
double median_step(std::span<const double> times_s, std::size_t first, std::size_t last) {
  std::vector<double> steps;
  for (std::size_t k = first; k < last; ++k) steps.push_back(step_to(times_s, k));
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

bool is_alike(double one, double other, double tolerance) {
  return std::abs(one - other) <= tolerance * std::min(one, other);
}

PeriodBlock block_of(std::span<const double> times_s, std::size_t first, std::size_t last) {
  return {first, last, last < first + 2 ? 0.0 : median_step(times_s, first + 1, last)};
}

bool is_good(std::span<const double> times_s, const PeriodBlock& block, double tolerance) {
  if (block.last - block.first < kFewestInBlock) return false;
  std::size_t alike = 0;
  for (std::size_t k = block.first + 1; k < block.last; ++k) {
    if (is_alike(step_to(times_s, k), block.period_s, tolerance)) ++alike;
  }
  return static_cast<double>(alike) >=
         kFewestAlike * static_cast<double>(block.last - block.first - 1);
}

/// Cuts in front of each sample at which the median of the steps before differs from that of those
/// from there on.
std::vector<PeriodBlock> cut_blocks(std::span<const double> times_s, double tolerance) {
  std::vector<PeriodBlock> blocks;
  std::size_t first = 0;
  for (std::size_t k = 2; k < times_s.size(); ++k) {
    if (k < first + 2) continue;
    const std::size_t from = std::max(first + 1, k > kWindow ? k - kWindow : 1);
    const double before_s = median_step(times_s, from, k);
    if (is_alike(step_to(times_s, k), before_s, tolerance)) continue;
    // Behind a pause, the steps after it.
    const std::size_t to = std::min(times_s.size(), k + 1 + kWindow);
    if (k + 1 >= to || is_alike(median_step(times_s, k + 1, to), before_s, tolerance)) continue;
    blocks.push_back(block_of(times_s, first, k));
    first = k;
  }
  blocks.push_back(block_of(times_s, first, times_s.size()));
  return blocks;
}

/// Whether the samples behind `before` up to those of `after`, of the same period, come as late in
/// all as they would have come one by one.
bool is_burst(std::span<const double> times_s, const PeriodBlock& before, const PeriodBlock& after,
              double tolerance) {
  if (!is_alike(before.period_s, after.period_s, tolerance)) return false;
  const double elapsed_s = times_s[after.first] - times_s[before.last - 1];
  const auto steps = static_cast<double>(after.first - before.last + 1);
  return std::abs(elapsed_s / before.period_s - steps) <= kBurstError_periods;
}

/// Joins what cutting parted without need: neighbours of one period, and those around a burst.
std::vector<PeriodBlock> joined_blocks(std::span<const double> times_s,
                                       const std::vector<PeriodBlock>& blocks, double tolerance) {
  std::vector<PeriodBlock> joined;
  for (const auto& block : blocks) {
    std::size_t back = 0;  // blocks that the new one makes one with
    for (std::size_t i = 1; i <= std::min<std::size_t>(2, joined.size()); ++i) {
      const PeriodBlock& earlier = joined[joined.size() - i];
      const bool is_next = i == 1 && is_alike(earlier.period_s, block.period_s, tolerance);
      if (is_next || (i == 2 && is_burst(times_s, earlier, block, tolerance))) back = i;
    }
    if (back == 0) {
      joined.push_back(block);
      continue;
    }
    joined.resize(joined.size() - back + 1);
    joined.back().last = block.last;
  }
  return joined;
}

std::vector<std::size_t> changes_within(std::span<const double> times_s, double tolerance) {
  const auto blocks = joined_blocks(times_s, cut_blocks(times_s, tolerance), tolerance);
  std::size_t good_samples = 0;
  std::size_t good_blocks = 0;
  for (const auto& block : blocks) {
    const bool good = is_good(times_s, block, tolerance);
    if (!good && block.last - block.first >= kFewestInBlock) return {};
    if (!good) continue;
    good_samples += block.last - block.first;
    ++good_blocks;
  }
  const bool are_blocks =
      good_blocks >= 2 &&
      static_cast<double>(good_samples) >= kFewestInBlocks * static_cast<double>(times_s.size());
  std::vector<std::size_t> changes;
  if (!are_blocks) return changes;
  for (const auto& block : blocks) {
    if (block.first > 0) changes.push_back(block.first);
  }
  return changes;
}

}  // namespace

std::vector<std::size_t> period_changes(std::span<const double> times_s) {
  if (times_s.size() < 2 * kFewestInBlock) return {};
  constexpr double kEvenClock = 0.1;
  constexpr double kUnevenClock = 0.25;
  auto changes = changes_within(times_s, kEvenClock);
  return changes.empty() ? changes_within(times_s, kUnevenClock) : changes;
}

}  // namespace flexarm::measured
