#include "measured/files/csv.hpp"

#include "arm/input_error.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/record_constants.hpp"

#include <fmt/format.h>

namespace flexarm::measured {

namespace {

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

}  // namespace

CsvReader::CsvReader(std::string_view text) : text_(text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
}

bool CsvReader::next() {
  cells_.clear();
  rewritten_.clear();
  if (!pass_what_is_no_row()) return false;
  row_line_ = line_;
  while (true) {
    pass_blanks();
    const bool is_quoted = at_ < text_.size() && text_[at_] == '"';
    cells_.push_back(is_quoted ? quoted_cell() : plain_cell());
    if (cells_.size() > kMostRecordColumns) {
      throw arm::InputError(
          fmt::format("more than {0} cells; a table has at most {0} columns", kMostRecordColumns));
    }
    if (at_ == text_.size() || text_[at_] != ',') break;
    ++at_;
  }
  pass_line_end();
  return true;
}

/// Passes blank lines and comments; false at the end of the text.
bool CsvReader::pass_what_is_no_row() {
  while (at_ < text_.size()) {
    std::size_t first = at_;
    while (first < text_.size() && is_blank(text_[first])) ++first;
    const bool is_empty = first == text_.size() || ends_line(text_[first]);
    if (!is_empty && text_[first] != '#') return true;
    while (first < text_.size() && !ends_line(text_[first])) ++first;
    at_ = first;
    pass_line_end();
  }
  return false;
}

std::string_view CsvReader::plain_cell() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != ',' && !ends_line(text_[at_])) ++at_;
  std::size_t end = at_;
  while (end > begin && is_blank(text_[end - 1])) --end;
  return text_.substr(begin, end - begin);
}

std::string_view CsvReader::quoted_cell() {
  const int begin_line = line_;
  const std::size_t begin = ++at_;
  bool has_quotes = false;
  for (; at_ < text_.size(); ++at_) {
    if (text_[at_] == '\n') ++line_;
    if (text_[at_] != '"') continue;
    if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
      has_quotes = true;
      ++at_;
      continue;
    }
    const std::string_view content = text_.substr(begin, at_ - begin);
    end_quoted_cell();
    if (!has_quotes) return content;
    std::string& single = rewritten_.emplace_back();
    for (std::size_t i = 0; i < content.size(); ++i) {
      if (content[i] == '"') ++i;
      single += content[i];
    }
    return single;
  }
  row_line_ = begin_line;
  throw arm::InputError("a quote is not closed; end the cell with \"");
}

void CsvReader::end_quoted_cell() {
  ++at_;
  pass_blanks();
  if (at_ < text_.size() && text_[at_] != ',' && !ends_line(text_[at_])) {
    row_line_ = line_;
    throw arm::InputError("text after a closing quote; write a quote within quotes twice, as \"\"");
  }
}

void CsvReader::pass_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

void CsvReader::pass_line_end() {
  if (at_ < text_.size() && text_[at_] == '\r') ++at_;
  if (at_ < text_.size() && text_[at_] == '\n') ++at_;
  ++line_;
}

std::vector<CsvRow> parse_csv(std::string_view text, const std::string& file_name) {
  std::vector<CsvRow> rows;
  CsvReader reader(text);
  try {
    while (reader.next()) {
      rows.push_back({reader.line(), {reader.cells().begin(), reader.cells().end()}});
    }
  } catch (const arm::InputError& error) {
    throw arm::located(error, file_name, reader.line());
  }
  return rows;
}

}  // namespace flexarm::measured
