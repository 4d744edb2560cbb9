#include "report/tables/text_table.hpp"

#include "report/tables/table_layout.hpp"
#include "report/utf8_text.hpp"
#include "report/wrapped_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace flexarm::report {
namespace {

constexpr std::string_view kMissingText = "-";
constexpr std::size_t kColumnGap = 2;
constexpr int kSmallestPlainExponent = -4;  // 0.00012 is easier to read than 1.2e-04

/// Text of fewer columns than this is not broken up beside others.
constexpr std::size_t kLeastText = 24;

/// One column as text; a name or a text cell may take several lines.
struct RenderedColumn {
  std::string name;
  std::string unit;
  std::vector<std::string> cells;
  bool is_text = false;
  bool joined = false;
  std::size_t width = 0;
};

using Columns = std::vector<RenderedColumn*>;

std::string padded(std::string_view text, std::size_t width, bool to_the_right) {
  const std::string blanks(width - std::min(width, display_width(text)), ' ');
  return to_the_right ? blanks + std::string(text) : std::string(text) + blanks;
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

std::size_t widest_cell(const RenderedColumn& column) {
  std::size_t width = display_width(column.unit);
  for (const std::string& cell : column.cells) width = std::max(width, display_width(cell));
  return width;
}

/// The width with the name broken into its words.
std::size_t width_below_words(const RenderedColumn& column) {
  return std::max(widest_cell(column), longest_word(column.name));
}

/// The width with name and text broken into their words.
std::size_t least_width(const RenderedColumn& column) {
  if (!column.is_text) return width_below_words(column);
  std::size_t width = std::max(display_width(column.unit), longest_word(column.name));
  for (const std::string& cell : column.cells) width = std::max(width, longest_word(cell));
  return width;
}

RenderedColumn render(const Table& table, std::size_t index) {
  const Column& column = table.columns[index];
  RenderedColumn rendered{.name = column.name,
                          .unit = column.unit.empty() ? "" : "[" + column.unit + "]",
                          .cells = {},
                          .joined = column.joined};
  for (const auto& row : table.rows) {
    rendered.cells.push_back(cell_text(row[index], column));
    rendered.is_text |= std::holds_alternative<std::string>(row[index]);
  }
  if (!rendered.is_text) align_points(rendered.cells);
  rendered.width = std::max(widest_cell(rendered), display_width(rendered.name));
  return rendered;
}

/// One row of cells, or of names: as many lines as the tallest field. The lines of `fields` stand
/// at the bottom for names, at the top for cells.
std::string row_text(const Columns& columns, const std::vector<std::vector<std::string>>& fields,
                     bool at_bottom) {
  std::size_t height = 1;
  for (const auto& field : fields) height = std::max(height, field.size());
  std::string text;
  for (std::size_t row = 0; row < height; ++row) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::size_t above = at_bottom ? height - fields[i].size() : 0;
      const bool is_blank = row < above || row - above >= fields[i].size();
      if (i > 0) line.append(kColumnGap, ' ');
      line +=
          padded(is_blank ? "" : fields[i][row - above], columns[i]->width, !columns[i]->is_text);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::vector<std::string> lines_of_cell(const RenderedColumn& column, std::size_t row) {
  const std::string& cell = column.cells[row];
  // Numbers keep the blanks behind them that align their points.
  const bool is_one_line = !column.is_text || display_width(cell) <= column.width;
  return is_one_line ? std::vector{cell} : wrapped(cell, column.width, column.width);
}

std::size_t width_of(const Columns& columns) {
  std::size_t width = columns.empty() ? 0 : (columns.size() - 1) * kColumnGap;
  for (const RenderedColumn* column : columns) width += column->width;
  return width;
}

std::string block(const Columns& columns, std::size_t row_count) {
  std::vector<std::vector<std::string>> names;
  std::vector<std::vector<std::string>> units;
  bool has_units = false;
  for (const RenderedColumn* column : columns) {
    names.push_back(wrapped(column->name, column->width, column->width));
    units.push_back({column->unit});
    has_units |= !column->unit.empty();
  }
  std::string text = row_text(columns, names, true);
  if (has_units) text += row_text(columns, units, true);
  text += std::string(width_of(columns), '-') + "\n";
  for (std::size_t row = 0; row < row_count; ++row) {
    std::vector<std::vector<std::string>> cells;
    for (const RenderedColumn* column : columns) cells.push_back(lines_of_cell(*column, row));
    text += row_text(columns, cells, false);
  }
  return text;
}

Columns pointers_to(std::vector<RenderedColumn>& columns) {
  Columns all;
  for (RenderedColumn& column : columns) all.push_back(&column);
  return all;
}

/// Names that were broken and have room stay whole.
void mend_names(const Columns& columns, std::size_t max_width) {
  for (RenderedColumn* column : columns) {
    const std::size_t broken = column->width;
    if (broken < widest_cell(*column)) continue;  // its text is broken as well
    column->width = std::max(broken, display_width(column->name));
    if (width_of(columns) > max_width) column->width = broken;
  }
}

/// Breaks names, then text, until the columns fit in `max_width` beside each other. Returns whether
/// they do.
bool fits_beside(const Columns& columns, std::size_t max_width) {
  if (width_of(columns) <= max_width) return true;
  for (RenderedColumn* column : columns) column->width = width_below_words(*column);
  if (width_of(columns) <= max_width) {
    mend_names(columns, max_width);
    return true;
  }
  RenderedColumn& widest = **std::ranges::max_element(
      columns, {}, [](const RenderedColumn* one) { return one->is_text ? one->width : 0; });
  const std::size_t overflow = width_of(columns) - max_width;
  const std::size_t least = std::max(kLeastText, least_width(widest));
  if (!widest.is_text || widest.width < least + overflow) return false;
  widest.width -= overflow;
  return true;
}

/// Blocks below each other, each behind the key columns; empty where a column does not fit beside
/// them.
std::vector<Columns> blocks_of(std::vector<RenderedColumn>& columns, std::size_t keys,
                               std::size_t max_width) {
  Columns key_columns;
  for (std::size_t i = 0; i < keys; ++i) key_columns.push_back(&columns[i]);
  const std::size_t taken = width_of(key_columns) + (keys > 0 ? kColumnGap : 0);
  if (taken >= max_width) return {};
  const std::size_t room = max_width - taken;
  std::vector<LayoutColumn> others;
  for (std::size_t i = keys; i < columns.size(); ++i) {
    if (columns[i].is_text && columns[i].width > room) {
      columns[i].width = std::max(room, least_width(columns[i]));
    }
    if (columns[i].width > room) return {};
    others.push_back({columns[i].width, columns[i].joined});
  }
  std::vector<Columns> blocks;
  std::size_t next = keys;
  for (const std::size_t count : balanced_blocks(others, room, kColumnGap)) {
    blocks.push_back(key_columns);
    for (std::size_t end = next + count; next < end; ++next) {
      blocks.back().push_back(&columns[next]);
    }
    mend_names(blocks.back(), max_width);
  }
  return blocks;
}

/// A line or more for each cell, for a terminal that is too narrow for columns.
std::string records(const std::vector<RenderedColumn>& columns, std::size_t row_count,
                    std::size_t max_width) {
  std::string text;
  for (std::size_t row = 0; row < row_count; ++row) {
    if (row > 0) text += "\n";
    for (const RenderedColumn& column : columns) {
      const std::string unit = column.unit.empty() ? "" : " " + column.unit;
      text +=
          to_paragraph(fmt::format("{}{}: {}", column.name, unit, column.cells[row]), 2, max_width);
    }
  }
  return text;
}

}  // namespace

std::string cell_text(const Cell& cell, const Column& column) {
  if (is_missing(cell)) return std::string(kMissingText);
  if (const auto* number = std::get_if<double>(&cell)) {
    return format_number(*number, column.significant_digits, column.notation);
  }
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
  return std::get<std::string>(cell);
}

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
  std::string text = table.caption.empty() ? "" : to_paragraph(table.caption, 0, options.max_width);
  std::vector<RenderedColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) columns.push_back(render(table, i));
  if (columns.empty()) return text;

  const Columns all = pointers_to(columns);
  if (fits_beside(all, options.max_width)) return text + block(all, table.rows.size());
  const std::size_t keys = std::min(options.key_columns, columns.size());
  const auto blocks = blocks_of(columns, keys, options.max_width);
  if (blocks.empty()) return text + records(columns, table.rows.size(), options.max_width);
  for (const Columns& shown : blocks) {
    if (&shown != &blocks.front()) text += "\n";
    text += block(shown, table.rows.size());
  }
  return text;
}

Table first_rows(const Table& table, std::size_t most) {
  Table shown{table.caption, table.columns, {}};
  const auto end =
      table.rows.begin() + static_cast<std::ptrdiff_t>(std::min(most, table.rows.size()));
  shown.rows.assign(table.rows.begin(), end);
  return shown;
}

std::string to_paragraph(std::string_view text, std::size_t indent, std::size_t max_width) {
  const std::size_t first_indent = std::min(text.find_first_not_of(' '), text.size());
  const auto room = [max_width](std::size_t taken) {
    return max_width - std::min(taken, max_width);
  };
  std::string paragraph(first_indent, ' ');
  std::size_t count = 0;
  for (const std::string& line : wrapped(text, room(first_indent), room(indent))) {
    if (count++ > 0) paragraph += "\n" + std::string(indent, ' ');
    paragraph += line;
  }
  return paragraph + "\n";
}

}  // namespace flexarm::report
