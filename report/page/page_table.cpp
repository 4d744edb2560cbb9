#include "report/page/page_table.hpp"

#include "report/page/page_words.hpp"
#include "report/tables/text_table.hpp"
#include "report/words.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::report::page {

namespace {

bool is_blank(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text != nullptr ? text->empty() : is_missing(cell);
}

}  // namespace

TableBlock table_block(const Table& table, const std::string& id, const std::string& caption) {
  TableBlock block{{id, text_in_words(table.caption), caption}, {}, {}};
  block.rows.resize(table.rows.size());
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    const bool has_values = std::ranges::any_of(
        table.rows, [c](const std::vector<Cell>& row) { return !is_blank(row[c]); });
    if (!has_values && !table.rows.empty()) continue;
    const bool has_text = std::ranges::any_of(table.rows, [c](const std::vector<Cell>& row) {
      return std::holds_alternative<std::string>(row[c]);
    });
    // A 1 that is no unit is a number.
    const auto in_page = [&](const std::string& text) {
      return text == "1" && column.name != "unit" ? text : unit_text(text_in_words(text));
    };
    const std::string title = column.name == "+-" ? "±" : text_in_words(column.name);
    block.columns.push_back({title, unit_text(column.unit), !has_text});
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const Cell& cell = table.rows[r][c];
      const std::string text = is_missing(cell) ? "–" : cell_text(cell, column);
      block.rows[r].push_back(has_text ? in_page(text) : text);
    }
  }
  return block;
}

void add_table(Section& section, const Table& table, const std::string& id,
               const std::string& caption) {
  section.add(table_block(table, id, caption));
}

}  // namespace flexarm::report::page
