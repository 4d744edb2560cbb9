#include "report/page/array_bytes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace flexarm::report::page {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

/// The numbers of a reference as a page decodes them, on a little-endian machine.
template <class Number>
std::vector<Number> decoded(const ArrayBytes& bytes, const OrderedJson& ref) {
  std::vector<Number> values(ref["count"].get<std::size_t>());
  if (values.empty()) return values;
  std::memcpy(values.data(), bytes.bytes().data() + ref["byte_offset"].get<std::size_t>(),
              values.size() * sizeof(Number));
  return values;
}

TEST(Base64, IsThatOfTheStandard) {
  // RFC 4648, section 10.
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foob"), "Zm9vYg==");
  EXPECT_EQ(to_base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(to_base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(ArrayBytes, NumbersComeBackBitForBit) {
  ArrayBytes bytes;
  const std::vector<float> singles = {1.5F, -0.0F, 3e38F, 1e-42F, kNoNumber};
  const std::vector<double> doubles = {0.1, -1e300, std::numeric_limits<double>::denorm_min()};
  const OrderedJson first = bytes.add(std::span<const float>(singles));
  const OrderedJson second = bytes.add(std::span<const double>(doubles));
  EXPECT_EQ(first["type"], "f32");
  EXPECT_EQ(second["type"], "f64");
  const auto back = decoded<float>(bytes, first);
  ASSERT_EQ(back.size(), singles.size());
  EXPECT_EQ(std::memcmp(back.data(), singles.data(), sizeof(float) * singles.size()), 0);
  EXPECT_EQ(decoded<double>(bytes, second), doubles);
}

TEST(ArrayBytes, ArraysBeginAtMultiplesOfEight) {
  ArrayBytes bytes;
  const std::vector<float> odd = {1.0F, 2.0F, 3.0F};
  bytes.add(std::span<const float>(odd));
  const std::vector<double> next = {4.0};
  EXPECT_EQ(bytes.add(std::span<const double>(next))["byte_offset"], 16);
}

TEST(ArrayBytes, TheSameArrayIsThereOnce) {
  ArrayBytes bytes;
  const std::vector<double> values = {1.0, 2.0, 3.0};
  const std::vector<double> others = {1.0, 2.0, 4.0};
  const OrderedJson first = bytes.add(std::span<const double>(values));
  const std::size_t size = bytes.size();
  EXPECT_EQ(bytes.add(std::span<const double>(values)), first);
  EXPECT_EQ(bytes.size(), size);
  EXPECT_NE(bytes.add(std::span<const double>(others)), first);
}

TEST(ArrayBytes, AnEnvelopeContainsWhatItIsOf) {
  std::mt19937 generator(2);
  std::normal_distribution<float> noise(1000.0F, 0.01F);
  std::vector<float> least(500);
  std::vector<float> greatest(500);
  for (std::size_t i = 0; i < least.size(); ++i) {
    least[i] = noise(generator);
    greatest[i] = least[i] + 0.001F;
  }
  least[7] = greatest[7] = kNoNumber;
  ArrayBytes bytes;
  const auto [low, high] = bytes.add_envelope(least, greatest);
  EXPECT_EQ(low["type"], "i16");
  const double scale = low["scale"];
  const double offset = low["offset"];
  EXPECT_EQ(high["scale"], scale);
  // The range in 65,534 steps.
  EXPECT_LT(scale, 0.1 / 65'534.0);
  const auto low_integers = decoded<std::int16_t>(bytes, low);
  const auto high_integers = decoded<std::int16_t>(bytes, high);
  const double rounding = 1e-12 * 1000.0;
  for (std::size_t i = 0; i < least.size(); ++i) {
    if (std::isnan(least[i])) {
      EXPECT_EQ(low_integers[i], -32768);
      EXPECT_EQ(high_integers[i], -32768);
      continue;
    }
    const double below = offset + scale * low_integers[i];
    const double above = offset + scale * high_integers[i];
    EXPECT_LE(below, static_cast<double>(least[i]) + rounding);
    EXPECT_GE(below, static_cast<double>(least[i]) - 1.001 * scale);
    EXPECT_GE(above, static_cast<double>(greatest[i]) - rounding);
    EXPECT_LE(above, static_cast<double>(greatest[i]) + 1.001 * scale);
  }
}

TEST(ArrayBytes, AnEnvelopeOfAConstantOrOfGapsAloneIsFinite) {
  ArrayBytes bytes;
  const std::vector<float> constant(3, 5.0F);
  const auto [low, high] = bytes.add_envelope(constant, constant);
  EXPECT_EQ(low["offset"], 5.0);
  EXPECT_EQ(decoded<std::int16_t>(bytes, low), std::vector<std::int16_t>(3, 0));
  const std::vector<float> gaps(3, kNoNumber);
  const auto [low_gaps, high_gaps] = bytes.add_envelope(gaps, gaps);
  EXPECT_TRUE(low_gaps["scale"].is_number());
  EXPECT_EQ(decoded<std::int16_t>(bytes, high_gaps), std::vector<std::int16_t>(3, -32768));
}

}  // namespace
}  // namespace flexarm::report::page
