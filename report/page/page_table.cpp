#include "report/page/page_table.hpp"

#include "report/page/page_words.hpp"
#include "report/tables/text_table.hpp"

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
  TableBlock block{{id, in_words(table.caption), caption}, {}, {}};
  block.rows.resize(table.rows.size());
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    const bool has_values = std::ranges::any_of(
        table.rows, [c](const std::vector<Cell>& row) { return !is_blank(row[c]); });
    if (!has_values && !table.rows.empty()) continue;
    const bool has_text = std::ranges::any_of(table.rows, [c](const std::vector<Cell>& row) {
      return std::holds_alternative<std::string>(row[c]);
    });
    const std::string title = column.name == "+-" ? "±" : in_words(column.name);
    block.columns.push_back({title, printed_unit(column.unit), !has_text});
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const Cell& cell = table.rows[r][c];
      const std::string text = is_missing(cell) ? "–" : cell_text(cell, column);
      block.rows[r].push_back(has_text ? printed_unit(in_words(text)) : text);
    }
  }
  return block;
}

void add_table(Section& section, const Table& table, const std::string& id,
               const std::string& caption) {
  if (!table.rows.empty()) section.blocks.emplace_back(table_block(table, id, caption));
}

}  // namespace flexarm::report::page
