#include "report/page/envelope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace flexarm::report::page {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::vector<float> random_walk(std::size_t count) {
  std::mt19937 generator(5);
  std::normal_distribution<float> step;
  std::vector<float> values(count);
  float at = 0.0F;
  for (float& value : values) value = at += step(generator);
  return values;
}

/// The level by its definition.
EnvelopeLevel by_definition(const std::vector<float>& values, std::size_t bucket) {
  EnvelopeLevel level{bucket, {}, {}};
  for (std::size_t from = 0; from < values.size(); from += bucket) {
    std::vector<float> own;
    for (std::size_t k = from; k < std::min(values.size(), from + bucket); ++k) {
      if (!std::isnan(values[k])) own.push_back(values[k]);
    }
    level.least.push_back(own.empty() ? kNaN : *std::ranges::min_element(own));
    level.greatest.push_back(own.empty() ? kNaN : *std::ranges::max_element(own));
  }
  return level;
}

void expect_same(const std::vector<float>& one, const std::vector<float>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (std::isnan(other[i])) {
      EXPECT_TRUE(std::isnan(one[i])) << i;
    } else {
      EXPECT_EQ(one[i], other[i]) << i;
    }
  }
}

TEST(Envelope, LevelsAreTheLeastAndGreatestOfTheirBuckets) {
  const auto values = random_walk(10'007);  // a prime: the last bucket is never whole
  for (const std::size_t finest : {1U, 2U, 3U, 7U}) {
    const auto levels = envelope(values, finest);
    ASSERT_GT(levels.size(), 1U);
    std::size_t bucket = finest;
    for (const auto& level : levels) {
      EXPECT_EQ(level.samples_per_bucket, bucket);
      const auto expected = by_definition(values, bucket);
      expect_same(level.least, expected.least);
      expect_same(level.greatest, expected.greatest);
      bucket *= kLevelRatio;
    }
    EXPECT_LE(levels.back().least.size(), kFewestBuckets);
    EXPECT_GT(levels[levels.size() - 2].least.size(), kFewestBuckets);
  }
}

TEST(Envelope, GapsRemainWhereABucketHasNoNumber) {
  auto values = random_walk(5000);
  std::fill(values.begin() + 1000, values.begin() + 1200, kNaN);
  std::fill(values.begin() + 3001, values.begin() + 3003, kNaN);
  const auto levels = envelope(values, 4);
  for (const auto& level : levels) {
    const auto expected = by_definition(values, level.samples_per_bucket);
    expect_same(level.least, expected.least);
    expect_same(level.greatest, expected.greatest);
  }
  EXPECT_TRUE(std::isnan(levels.front().least[260]));
  EXPECT_FALSE(std::isnan(levels.front().least[750]));  // beside the short gap
}

TEST(Envelope, OfNoSampleOrOneIsOneLevel) {
  EXPECT_EQ(envelope({}, 3).size(), 1U);
  const std::vector<float> one = {2.0F};
  const auto levels = envelope(one, 3);
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels.front().least, one);
}

TEST(Envelope, BucketsAreCountedWithoutComputingThem) {
  const auto values = random_walk(9001);
  for (const std::size_t finest : {1U, 2U, 5U, 40U}) {
    std::size_t count = 0;
    for (const auto& level : envelope(values, finest)) count += level.least.size();
    EXPECT_EQ(envelope_buckets(values.size(), finest), count);
  }
}

TEST(Envelope, FinestBucketIsTheSmallestThatFits) {
  for (const std::size_t cap : {3'000U, 20'000U, 500'000U}) {
    const std::size_t bucket = finest_bucket(1'000'000, cap);
    EXPECT_LE(kBytesPerBucket * envelope_buckets(1'000'000, bucket), cap);
    EXPECT_GT(kBytesPerBucket * envelope_buckets(1'000'000, bucket - 1), cap);
  }
}

TEST(RecordCap, ShortRecordsAreWholeAndLongOnesShareTheRest) {
  const std::vector<std::size_t> lengths = {1'000'000, 100, 1'000'000, 4'000};
  const std::size_t cap = record_cap_bytes(lengths, 100'000);
  EXPECT_GE(cap, 4'000 * kBytesPerSample);
  EXPECT_EQ(cap, (100'000 - 4'100 * kBytesPerSample) / 2);
}

TEST(RecordCap, NeverMoreThanTheRoom) {
  std::mt19937 generator(3);
  std::uniform_int_distribution<std::size_t> length(1, 50'000);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<std::size_t> lengths(1 + static_cast<std::size_t>(trial) % 40);
    for (auto& one : lengths) one = length(generator);
    const std::size_t room = 4 * length(generator);
    const std::size_t cap = record_cap_bytes(lengths, room);
    std::size_t sum = 0;
    for (const auto one : lengths) sum += std::min(cap, one * kBytesPerSample);
    EXPECT_LE(sum, room);
  }
}

TEST(RecordCap, OfRecordsThatFitIsTheLongest) {
  EXPECT_EQ(record_cap_bytes(std::vector<std::size_t>{10, 30, 20}, 1'000), 120U);
}

}  // namespace
}  // namespace flexarm::report::page
