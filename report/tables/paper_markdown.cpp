#include "report/tables/paper_markdown.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "report/tables/paper_tables.hpp"
#include "report/tables/text_table.hpp"

#include <fmt/format.h>

#include <vector>

namespace flexarm::report {

namespace {

using namespace compare::paper;

// A mark stands at the start of a line.
constexpr std::string_view kOpen = "\n<!-- flexarm paper: ";
constexpr std::string_view kClose = " -->";
constexpr std::string_view kEnd = "\n<!-- end -->";

/// Text of the checks as Markdown shows it: a bar would end a cell, and signs of emphasis and of
/// HTML mean themselves.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("|*_<>").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string markdown_cell(const Cell& cell, const Column& column) {
  if (is_missing(cell)) return "";
  if (const auto* number = std::get_if<double>(&cell)) {
    return format_number(*number, column.significant_digits, column.notation);
  }
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
  return escaped(std::get<std::string>(cell));
}

std::string row_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const auto& cell : cells) line += fmt::format(" {}{}|", cell, cell.empty() ? "" : " ");
  return line + '\n';
}

std::string markdown(const Table& table) {
  std::vector<std::string> names, rule;
  for (const auto& column : table.columns) {
    names.push_back(column.name);
    rule.push_back("---");
  }
  std::string out = row_line(names) + row_line(rule);
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (std::size_t k = 0; k < row.size(); ++k) {
      cells.push_back(markdown_cell(row[k], table.columns[k]));
    }
    out += row_line(cells);
  }
  return out;
}

std::string topic_block(const Topic& topic) {
  std::string findings;
  Table values;
  for (const auto& check : topic.checks) {
    findings +=
        fmt::format("- **{}** {}: *{}.* {}\n", escaped(check.label), escaped(check.statement),
                    to_string(check.verdict), escaped(check.finding));
    Table own = paper_values(check);
    if (values.columns.empty()) {
      values.columns = own.columns;
      values.columns.insert(values.columns.begin(), Column{.name = "part"});
    }
    bool first = true;
    for (auto& row : own.rows) {
      row.insert(row.begin(), first ? Cell{check.label} : Cell{});
      values.add_row(std::move(row));
      first = false;
    }
  }
  return findings + '\n' + markdown(values);
}

}  // namespace

std::string paper_block(const Findings& findings, const std::string& name) {
  if (name == "overview") {
    return fmt::format("{}\n\n{}\n", paper_verdict_line(findings), escaped(describe_arms()));
  }
  if (name == "cells") {
    return paper_cells_line(findings) + "\n\n" + markdown(paper_cells(findings));
  }
  std::vector<std::string> names = {"overview", "cells"};
  for (const auto& topic : findings.topics) {
    if (topic.name == name) return topic_block(topic);
    names.push_back(topic.name);
  }
  throw arm::InputError(
      fmt::format("no block named \"{}\"{}", name, arm::did_you_mean(name, names)));
}

std::string updated_paper_document(const std::string& document, const Findings& findings) {
  if (document.find(kOpen) == std::string::npos) {
    throw arm::InputError(fmt::format("has no block {}NAME -->", kOpen.substr(1)));
  }
  std::string out;
  std::size_t at = 0;
  while (true) {
    const std::size_t open = document.find(kOpen, at);
    if (open == std::string::npos) return out + document.substr(at);
    const std::size_t name = open + kOpen.size();
    const std::size_t close = document.find(kClose, name);
    const std::size_t end = document.find(kEnd, name);
    if (close == std::string::npos || end == std::string::npos) {
      throw arm::InputError("a block of flexarm paper has no line <!-- end -->");
    }
    const std::size_t body = close + kClose.size();
    out += document.substr(at, body - at) + "\n" +
           paper_block(findings, document.substr(name, close - name));
    at = end + 1;  // kEnd begins with the line's end that the block has written
  }
}

}  // namespace flexarm::report
