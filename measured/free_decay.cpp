#include "measured/free_decay.hpp"

#include "measured/modal/modal_fit.hpp"
#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace flexarm::measured {

namespace {

/// Windows that a record is looked through for the release of an arm, samples in the shortest, and
/// the part of the largest standard deviation from which one moves.
constexpr std::size_t kStretchesOfRecord = 50;
constexpr std::size_t kLeastWindow = 8;
constexpr double kMoves = 0.5;
/// The part below which, in the median, windows before that are of an arm that is held.
constexpr double kQuiet = 0.1;

/// Standard deviation of the values within each of the windows that follow each other.
std::vector<double> local_deviations(std::span<const double> values, std::size_t window) {
  std::vector<double> deviations;
  for (std::size_t first = 0; first + window <= values.size(); first += window) {
    deviations.push_back(standard_deviation(values.subspan(first, window)));
  }
  return deviations;
}

/// The end of the first window that moves at least half as much as any, 0 where that is the very
/// first: an arm that is held, bent or not, does not move before its release.
std::size_t begin_of_motion(std::span<const double> values) {
  std::size_t looked_at = values.size();
  while (true) {
    const std::size_t window = std::max(kLeastWindow, looked_at / kStretchesOfRecord);
    const auto deviations = local_deviations(values.first(looked_at), window);
    const double largest = *std::ranges::max_element(deviations);
    const auto moves = std::ranges::find_if(
        deviations, [&](double deviation) { return deviation >= kMoves * largest; });
    const auto index = static_cast<std::size_t>(moves - deviations.begin());
    if (index > 0) {
      const bool is_quiet = median({deviations.begin(), moves}) <= kQuiet * largest;
      return is_quiet ? (index + 1) * window : 0;
    }
    if (window == kLeastWindow) return 0;
    looked_at = 2 * window;
  }
}

}  // namespace

std::size_t begin_of_decay(const TimeRecord& record) {
  const std::size_t samples = record.time_s.size();
  if (samples < kLeastSamples) return 0;
  std::size_t begin = 0;
  for (const Channel& channel : record.channels) {
    if (arm::is_collocated(channel.sensor)) continue;
    begin = std::max(begin, begin_of_motion(channel.values));
  }
  return begin + kLeastSamples <= samples ? begin : 0;
}

}  // namespace flexarm::measured
