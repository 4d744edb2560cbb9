#include "report/tables/text_table.hpp"

#include "report/utf8_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

namespace flexarm::report {
namespace {

constexpr std::string_view kMissingText = "-";
constexpr std::size_t kColumnGap = 2;
constexpr int kSmallestPlainExponent = -4;  // 0.00012 is easier to read than 1.2e-04

/// One column as text: every cell padded to the same width.
struct RenderedColumn {
  std::string name;
  std::string unit;
  std::vector<std::string> cells;
  std::size_t width = 0;
};

std::string padded(std::string_view text, std::size_t width, bool to_the_right) {
  const std::string blanks(width - std::min(width, display_width(text)), ' ');
  return to_the_right ? blanks + std::string(text) : std::string(text) + blanks;
}

std::string cell_text(const Cell& cell, const Column& column) {
  if (is_missing(cell)) return std::string(kMissingText);
  if (const auto* number = std::get_if<double>(&cell)) {
    return format_number(*number, column.significant_digits, column.notation);
  }
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
  return std::get<std::string>(cell);
}

/// Characters in front of the decimal point, or of the exponent where there is no point.
std::size_t whole_part(std::string_view number) {
  return std::min(number.find_first_of(".e"), number.size());
}

/// Pads on the right so that the decimal points of a right-aligned column stand in one line.
void align_points(std::vector<std::string>& numbers) {
  std::size_t longest_tail = 0;
  for (const std::string& n : numbers) {
    if (n != kMissingText) longest_tail = std::max(longest_tail, n.size() - whole_part(n));
  }
  for (std::string& n : numbers) {
    if (n != kMissingText) n.append(longest_tail - (n.size() - whole_part(n)), ' ');
  }
}

RenderedColumn render(const Table& table, std::size_t index) {
  const Column& column = table.columns[index];
  RenderedColumn rendered{column.name, column.unit.empty() ? "" : "[" + column.unit + "]", {}, 0};
  bool has_text = false;
  for (const auto& row : table.rows) {
    rendered.cells.push_back(cell_text(row[index], column));
    has_text |= std::holds_alternative<std::string>(row[index]);
  }
  if (!has_text) align_points(rendered.cells);

  rendered.width = std::max(display_width(rendered.name), display_width(rendered.unit));
  for (const std::string& cell : rendered.cells) {
    rendered.width = std::max(rendered.width, display_width(cell));
  }
  rendered.name = padded(rendered.name, rendered.width, !has_text);
  rendered.unit = padded(rendered.unit, rendered.width, !has_text);
  for (std::string& cell : rendered.cells) cell = padded(cell, rendered.width, !has_text);
  return rendered;
}

std::string line(const std::vector<const std::string*>& fields) {
  std::string text;
  for (const std::string* field : fields) {
    if (!text.empty()) text.append(kColumnGap, ' ');
    text += *field;
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string block(const std::vector<const RenderedColumn*>& columns, std::size_t row_count) {
  std::vector<const std::string*> names;
  std::vector<const std::string*> units;
  std::size_t width = (columns.size() - 1) * kColumnGap;
  bool has_units = false;
  for (const RenderedColumn* column : columns) {
    names.push_back(&column->name);
    units.push_back(&column->unit);
    width += column->width;
    has_units |= column->unit.find('[') != std::string::npos;
  }
  std::string text = line(names);
  if (has_units) text += line(units);
  text += std::string(width, '-') + "\n";
  for (std::size_t row = 0; row < row_count; ++row) {
    std::vector<const std::string*> cells;
    for (const RenderedColumn* column : columns) cells.push_back(&column->cells[row]);
    text += line(cells);
  }
  return text;
}

}  // namespace

std::string format_number(double value, int significant_digits, Notation notation) {
  if (std::isnan(value)) return std::string(kMissingText);
  if (value == 0.0) return "0";
  std::string scientific = fmt::format("{:.{}e}", value, significant_digits - 1);
  if (notation == Notation::scientific || !std::isfinite(value)) return scientific;
  // The exponent after rounding says how many of the digits stand in front of the point.
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
  if (exponent < kSmallestPlainExponent || exponent >= significant_digits) return scientific;
  return fmt::format("{:.{}f}", value, significant_digits - 1 - exponent);
}

std::string to_text(const Table& table, const TextOptions& options) {
  std::vector<RenderedColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) columns.push_back(render(table, i));

  std::string text = table.caption.empty() ? "" : table.caption + "\n";
  const std::size_t keys = std::min(options.key_columns, columns.size());
  std::size_t next = keys;
  do {
    std::vector<const RenderedColumn*> shown;
    std::size_t width = 0;
    for (std::size_t i = 0; i < keys; ++i) {
      shown.push_back(&columns[i]);
      width += columns[i].width + kColumnGap;
    }
    const std::size_t first = next;
    while (next < columns.size() &&
           (next == first || width + columns[next].width <= options.max_width)) {
      shown.push_back(&columns[next]);
      width += columns[next].width + kColumnGap;
      ++next;
    }
    if (first > keys) text += "\n";
    if (!shown.empty()) text += block(shown, table.rows.size());
  } while (next < columns.size());
  return text;
}

std::string to_paragraph(std::string_view text, std::size_t indent, std::size_t max_width) {
  std::istringstream words{std::string(text)};
  std::string lines;
  std::string line;
  for (std::string word; words >> word;) {
    if (line.empty()) {
      line = word;
    } else if (display_width(line) + 1 + display_width(word) <= max_width) {
      line += " " + word;
    } else {
      lines += line + "\n";
      line = std::string(indent, ' ') + word;
    }
  }
  return lines + line + "\n";
}

}  // namespace flexarm::report
