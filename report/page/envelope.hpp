#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::report::page {

/// Least and greatest values of the buckets of a record: bucket i is of the samples from
/// i * samples_per_bucket on, the last one of those that are left. A bucket without a number is
/// NaN; numbers beside a gap make the bucket's values.
struct EnvelopeLevel {
  std::size_t samples_per_bucket = 1;
  std::vector<float> least;
  std::vector<float> greatest;
};

/// Levels from fine to coarse: buckets of `finest` samples, then `kLevelRatio` times as many from
/// level to level, to the first with at most `kFewestBuckets`. `finest` is 1 or more.
std::vector<EnvelopeLevel> envelope(std::span<const float> values, std::size_t finest);
inline constexpr std::size_t kLevelRatio = 4;
inline constexpr std::size_t kFewestBuckets = 512;

/// Buckets of all levels of `envelope`, without computing them.
std::size_t envelope_buckets(std::size_t samples, std::size_t finest);

/// Room for records in a page: each goes into it whole (4 bytes a sample) where it takes at most
/// `cap` bytes, else as an envelope (4 bytes a bucket) of at most that. The cap is the largest with
/// which records of these lengths take at most `most_bytes` together.
std::size_t record_cap_bytes(std::span<const std::size_t> lengths, std::size_t most_bytes);

/// The finest bucket with which the envelope takes at most `cap_bytes`, where coarser levels leave
/// room for it.
std::size_t finest_bucket(std::size_t samples, std::size_t cap_bytes);

inline constexpr std::size_t kBytesPerSample = 4;  // f32
inline constexpr std::size_t kBytesPerBucket = 4;  // two i16

}  // namespace flexarm::report::page
