#include "measured/files/raw_doubles.hpp"

#include "arm/input_error.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <utility>

namespace flexarm::measured {

namespace {

constexpr std::size_t kDouble_bytes = 8;

double double_at(const std::string& bytes, std::size_t at) {
  std::uint64_t bits = 0;
  for (std::size_t i = kDouble_bytes; i-- > 0;) {
    bits = bits << 8U | static_cast<unsigned char>(bytes[at + i]);
  }
  return std::bit_cast<double>(bits);
}

}  // namespace

ForeignTable read_raw_doubles(const std::filesystem::path& path, std::size_t columns) {
  const std::string name = arm::shown(path.string());
  if (columns < 2) {
    throw arm::InputError(fmt::format("--raw-columns {}: must be 2 or more", columns));
  }
  const std::string bytes = measured::read_text_file(path, kLargestRecord_bytes);
  const std::size_t row_bytes = kDouble_bytes * columns;
  const std::size_t rows = bytes.size() / row_bytes;
  if (bytes.size() % row_bytes != 0 || rows < 2) {
    throw arm::InputError(
        fmt::format("{}: {} bytes; must be two or more whole rows of {} doubles, {} bytes each",
                    name, bytes.size(), columns, row_bytes));
  }
  ForeignTable table;
  for (std::size_t j = 0; j < columns; ++j) {
    ForeignColumn column{fmt::format("column {}", j + 1), "", {}};
    column.values.reserve(rows);
    for (std::size_t row = 0; row < rows; ++row) {
      column.values.push_back(double_at(bytes, row * row_bytes + j * kDouble_bytes));
    }
    table.columns.push_back(std::move(column));
  }
  table.assumptions.push_back(
      fmt::format("doubles, little endian, {} rows of {} columns", rows, columns));
  return table;
}

}  // namespace flexarm::measured
