#include "report/tables/csv.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

namespace flexarm::report {
namespace {

void append_field(std::string& csv, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    csv += text;
    return;
  }
  csv += '"';
  for (const char c : text) {
    if (c == '"') csv += '"';
    csv += c;
  }
  csv += '"';
}

void append_cell(std::string& csv, const Cell& cell) {
  if (is_missing(cell)) return;
  if (const auto* number = std::get_if<double>(&cell)) {
    fmt::format_to(std::back_inserter(csv), "{}", *number);
  } else if (const auto* count = std::get_if<std::int64_t>(&cell)) {
    fmt::format_to(std::back_inserter(csv), "{}", *count);
  } else {
    append_field(csv, std::get<std::string>(cell));
  }
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string csv;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    if (i > 0) csv += ',';
    append_field(
        csv, column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
  }
  csv += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) csv += ',';
      append_cell(csv, row[i]);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace flexarm::report
