#include "arm/ascii.hpp"
#include "arm/input_error.hpp"
#include "measured/files/mat_levels.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

namespace flexarm::measured {

namespace {

/// The header of a matrix ("MAT-File Format", The MathWorks, "Level 4 MAT-files"): five whole
/// numbers of four bytes, of which the first is 1000 M + 100 O + 10 P + T.
struct Level4Header {
  bool little_endian = true;
  std::uint32_t precision = 0;  ///< P: double, single, int32, int16, uint16, uint8
  std::uint32_t kind = 0;       ///< T: numbers, text, sparse
  std::size_t rows = 0;
  std::size_t columns = 0;
  bool is_complex = false;
  std::size_t name_length = 0;  ///< with the 0 at its end
};

constexpr std::size_t kLevel4Header_bytes = 20;
constexpr std::size_t kLongestName4 = 64;
constexpr std::array<std::size_t, 6> kNumber_bytes = {8, 4, 4, 2, 2, 1};

std::uint64_t whole(std::string_view bytes, bool little_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char byte = bytes[little_endian ? bytes.size() - 1 - i : i];
    value = value << 8U | static_cast<unsigned char>(byte);
  }
  return value;
}

std::optional<Level4Header> header_of(std::string_view bytes) {
  if (bytes.size() < kLevel4Header_bytes) return std::nullopt;
  for (const bool little_endian : {true, false}) {
    const auto word = [&](std::size_t i) { return whole(bytes.substr(4 * i, 4), little_endian); };
    const auto type = word(0);
    const std::uint64_t precision = type / 10 % 10;
    const std::uint64_t kind = type % 10;
    const bool is_type = type / 1000 == (little_endian ? 0U : 1U) && type / 100 % 10 == 0 &&
                         precision < kNumber_bytes.size() && kind <= 2;
    if (!is_type || word(3) > 1 || word(4) < 2 || word(4) > kLongestName4) continue;
    return Level4Header{little_endian,
                        static_cast<std::uint32_t>(precision),
                        static_cast<std::uint32_t>(kind),
                        word(1),
                        word(2),
                        word(3) == 1,
                        word(4)};
  }
  return std::nullopt;
}

/// A letter, then letters, digits and _, ended by 0.
std::optional<std::string> name_of(std::string_view bytes) {
  if (bytes.empty() || !arm::is_letter(bytes.front()) || bytes.back() != '\0') return std::nullopt;
  std::string name(bytes.substr(0, bytes.find('\0')));
  for (const char c : name) {
    if (!arm::is_letter(c) && !arm::is_digit(c) && c != '_') return std::nullopt;
  }
  return name;
}

double level4_number(std::string_view bytes, const Level4Header& header) {
  const std::uint64_t bits = whole(bytes, header.little_endian);
  switch (header.precision) {
    case 0:
      return std::bit_cast<double>(bits);
    case 1:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case 2:
      return static_cast<double>(static_cast<std::int32_t>(bits));
    case 3:
      return static_cast<double>(static_cast<std::int16_t>(bits));
    default:
      return static_cast<double>(bits);
  }
}

std::vector<double> numbers_of(std::string_view bytes, const Level4Header& header) {
  const std::size_t size = kNumber_bytes[header.precision];
  std::vector<double> numbers;
  numbers.reserve(bytes.size() / size);
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    numbers.push_back(level4_number(bytes.substr(at, size), header));
  }
  return numbers;
}

void add_level4(const std::string& name, const Level4Header& header, MatNumbers numbers,
                MatContents& contents) {
  if (header.kind == 2) {
    contents.left_out.push_back(fmt::format("{}: a sparse matrix", name));
    return;
  }
  if (header.kind == 0) {
    add_numbers(name, std::move(numbers), contents);
    return;
  }
  add_text(name, numbers.real, header.rows, contents);
}

}  // namespace

bool is_level4(std::string_view bytes) {
  const auto header = header_of(bytes);
  return header && name_of(bytes.substr(kLevel4Header_bytes, header->name_length)).has_value();
}

MatContents level4_contents(std::string_view bytes) {
  MatContents contents{MatLevel::level4, {}, {}};
  while (!bytes.empty()) {
    const auto header = header_of(bytes);
    if (!header) throw arm::InputError("is cut off or damaged: no variable behind the last one");
    bytes.remove_prefix(kLevel4Header_bytes);
    const auto name = name_of(bytes.substr(0, header->name_length));
    if (!name) throw arm::InputError("is damaged: a name");
    bytes.remove_prefix(header->name_length);
    const std::size_t room = bytes.size() / kNumber_bytes[header->precision];
    const std::size_t parts = header->is_complex ? 2 : 1;
    if (header->rows > 0 && header->columns > room / parts / header->rows) {
      throw arm::InputError("is cut off");
    }
    const std::size_t size = header->rows * header->columns * kNumber_bytes[header->precision];
    MatNumbers numbers{{header->rows, header->columns}, {}, {}};
    numbers.real = numbers_of(bytes.substr(0, size), *header);
    if (header->is_complex) numbers.imaginary = numbers_of(bytes.substr(size, size), *header);
    bytes.remove_prefix(parts * size);
    add_level4(*name, *header, std::move(numbers), contents);
  }
  return contents;
}

}  // namespace flexarm::measured
