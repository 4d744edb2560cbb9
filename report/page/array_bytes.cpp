#include "report/page/array_bytes.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>

namespace flexarm::report::page {

namespace {

constexpr std::size_t kAlignment = 8;  // that of f64, so that a typed array can look at the bytes
constexpr std::int16_t kGapInteger = -32768;
constexpr double kLargestInteger = 32767.0;

template <class Unsigned, class Number>
std::string little_endian(std::span<const Number> numbers) {
  std::string bytes;
  bytes.reserve(numbers.size() * sizeof(Unsigned));
  for (const Number number : numbers) {
    auto bits = std::bit_cast<Unsigned>(number);
    for (std::size_t k = 0; k < sizeof(Unsigned); ++k) {
      bytes.push_back(static_cast<char>(bits & 0xffU));
      bits = static_cast<Unsigned>(bits >> 8U);
    }
  }
  return bytes;
}

nlohmann::ordered_json array_ref(const char* type, std::size_t byte_offset, std::size_t count) {
  return {{"type", type}, {"byte_offset", byte_offset}, {"count", count}};
}

}  // namespace

std::size_t ArrayBytes::place(const std::string& bytes) {
  const std::size_t hash = std::hash<std::string>{}(bytes);
  const auto [first, last] = placed_.equal_range(hash);
  for (auto at = first; at != last; ++at) {
    const auto& [offset, count] = at->second;
    if (std::string_view(bytes_).substr(offset, count) == bytes) return offset;
  }
  bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment);
  const std::size_t offset = bytes_.size();
  bytes_ += bytes;
  placed_.emplace(hash, std::pair(offset, bytes.size()));
  return offset;
}

nlohmann::ordered_json ArrayBytes::add(std::span<const double> values) {
  return array_ref("f64", place(little_endian<std::uint64_t>(values)), values.size());
}

nlohmann::ordered_json ArrayBytes::add(std::span<const float> values) {
  return array_ref("f32", place(little_endian<std::uint32_t>(values)), values.size());
}

std::pair<nlohmann::ordered_json, nlohmann::ordered_json> ArrayBytes::add_envelope(
    std::span<const float> least, std::span<const float> greatest) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const float value : least) low = value < low ? value : low;
  for (const float value : greatest) high = value > high ? value : high;
  if (low > high) low = high = 0.0;  // gaps alone
  const double offset = 0.5 * (low + high);
  const double half = 0.5 * (high - low);
  const double scale = half > 0.0 ? half / kLargestInteger : 1.0;
  const auto add_side = [&](std::span<const float> values, auto rounded) {
    std::vector<std::int16_t> integers;
    integers.reserve(values.size());
    for (const float value : values) {
      const double steps = rounded((static_cast<double>(value) - offset) / scale);
      integers.push_back(std::isnan(value) ? kGapInteger
                                           : static_cast<std::int16_t>(std::clamp(
                                                 steps, -kLargestInteger, kLargestInteger)));
    }
    const std::span<const std::int16_t> whole(integers);
    auto ref = array_ref("i16", place(little_endian<std::uint16_t>(whole)), values.size());
    ref["scale"] = scale;
    ref["offset"] = offset;
    return ref;
  };
  return {add_side(least, [](double steps) { return std::floor(steps); }),
          add_side(greatest, [](double steps) { return std::ceil(steps); })};
}

std::string ArrayBytes::base64() const {
  return to_base64(bytes_);
}

/// RFC 4648 with padding.
std::string to_base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::string_view group = bytes.substr(k, 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      bits = bits << 8U | (i < group.size() ? static_cast<unsigned char>(group[i]) : 0U);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      text += i <= group.size() ? kDigits[bits >> (18U - 6U * i) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace flexarm::report::page
