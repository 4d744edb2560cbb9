#include "report/page/envelope.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace flexarm::report::page {

namespace {

constexpr float kGap = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

std::size_t buckets_of(std::size_t samples, std::size_t bucket) {
  return (samples + bucket - 1) / bucket;
}

/// Buckets of `step` entries of `least` and `greatest`; comparisons pass over NaN.
EnvelopeLevel coarser(std::span<const float> least, std::span<const float> greatest,
                      std::size_t step) {
  EnvelopeLevel level;
  const std::size_t count = buckets_of(least.size(), step);
  level.least.reserve(count);
  level.greatest.reserve(count);
  for (std::size_t from = 0; from < least.size(); from += step) {
    const std::size_t to = std::min(least.size(), from + step);
    float low = kInfinite;
    float high = -kInfinite;
    for (std::size_t k = from; k < to; ++k) {
      low = least[k] < low ? least[k] : low;
      high = greatest[k] > high ? greatest[k] : high;
    }
    const bool is_gap = low > high;
    level.least.push_back(is_gap ? kGap : low);
    level.greatest.push_back(is_gap ? kGap : high);
  }
  return level;
}

}  // namespace

std::vector<EnvelopeLevel> envelope(std::span<const float> values, std::size_t finest) {
  std::vector<EnvelopeLevel> levels = {coarser(values, values, finest)};
  levels.back().samples_per_bucket = finest;
  while (levels.back().least.size() > kFewestBuckets) {
    EnvelopeLevel next = coarser(levels.back().least, levels.back().greatest, kLevelRatio);
    next.samples_per_bucket = levels.back().samples_per_bucket * kLevelRatio;
    levels.push_back(std::move(next));
  }
  return levels;
}

std::size_t envelope_buckets(std::size_t samples, std::size_t finest) {
  std::size_t count = buckets_of(samples, finest);
  std::size_t sum = count;
  while (count > kFewestBuckets) {
    count = buckets_of(count, kLevelRatio);
    sum += count;
  }
  return sum;
}

std::size_t record_cap_bytes(std::span<const std::size_t> lengths, std::size_t most_bytes) {
  std::vector<std::size_t> wanted;
  for (const std::size_t length : lengths) wanted.push_back(length * kBytesPerSample);
  std::ranges::sort(wanted);
  // The shortest ones take what they want; the others share evenly what these leave.
  std::size_t left = most_bytes;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::size_t share = left / (wanted.size() - i);
    if (wanted[i] > share) return share;
    left -= wanted[i];
  }
  return wanted.empty() ? most_bytes : wanted.back();
}

std::size_t finest_bucket(std::size_t samples, std::size_t cap_bytes) {
  std::size_t low = 1;
  std::size_t high = std::max<std::size_t>(1, samples);
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (envelope_buckets(samples, middle) * kBytesPerBucket <= cap_bytes) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

}  // namespace flexarm::report::page
