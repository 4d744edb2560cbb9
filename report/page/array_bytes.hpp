#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace flexarm::report::page {

/// The bytes of all arrays of a page, one behind the other, little-endian, each at a multiple of 8.
/// Arrays of the same bytes are there once. `add` returns an ArrayRef of the contract.
class ArrayBytes {
 public:
  nlohmann::ordered_json add(std::span<const double> values);
  nlohmann::ordered_json add(std::span<const float> values);
  /// Values as offset + scale * integer, rounded down and up: at most `scale` below `least`, above
  /// `greatest`; -32768 is a gap. The refs of both.
  std::pair<nlohmann::ordered_json, nlohmann::ordered_json> add_envelope(
      std::span<const float> least, std::span<const float> greatest);

  std::size_t size() const { return bytes_.size(); }
  const std::string& bytes() const { return bytes_; }
  std::string base64() const;

 private:
  /// Where the bytes are.
  std::size_t place(const std::string& bytes);

  std::string bytes_;
  std::unordered_multimap<std::size_t, std::pair<std::size_t, std::size_t>> placed_;
};

std::string to_base64(std::string_view bytes);

}  // namespace flexarm::report::page
