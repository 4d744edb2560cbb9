#include "measured/files/foreign_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/text_encoding.hpp"
#include "measured/files/text_file.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

/// So many lines tell how a file is written.
constexpr std::size_t kSample = 2000;

/// In the order preferred where two make the same cells numbers.
constexpr std::array<Dialect, 8> kDialects = {{{'\t', '.'},
                                               {'\t', ','},
                                               {';', '.'},
                                               {';', ','},
                                               {',', '.'},
                                               {',', ','},
                                               {' ', '.'},
                                               {' ', ','}}};

struct Line {
  int number = 0;
  string_view text;
};

/// Passes over the lines of a text one by one.
class LineReader {
 public:
  explicit LineReader(string_view text) : text_(text) {}

  bool next(Line& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    line = {++number_, text_.substr(at_, end - at_)};
    at_ = end + 1;
    if (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n') ++at_;
    return true;
  }

 private:
  string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

bool is_blank_line(string_view line) {
  return line.find_first_not_of(" \t\f\v") == string_view::npos;
}

/// The line without its comment mark; the line itself when it has none.
string_view without_comment_mark(string_view line) {
  const auto first = line.find_first_not_of(" \t");
  if (first == string_view::npos) return line;
  string_view rest = line.substr(first);
  if (rest.starts_with("//")) return rest.substr(2);
  while (rest.starts_with('#') || rest.starts_with('%')) rest.remove_prefix(1);
  return rest.size() == line.size() - first ? line : rest;
}

bool is_comment(string_view line) {
  return without_comment_mark(line).size() != line.size();
}

bool is_passed_over(string_view line) {
  return is_blank_line(line) || is_comment(line);
}

std::size_t count_numbers(std::span<const string_view> cells, char decimal) {
  return static_cast<std::size_t>(std::ranges::count_if(
      cells, [&](string_view cell) { return parse_cell(cell, decimal).has_value(); }));
}

/// A row has two numbers or more: time and something measured.
constexpr std::size_t kFewestNumbers = 2;
/// A line of names in front of rows of more cells has at least so many, and half as many as cells.
constexpr std::size_t kFewestNames = 3;

/// A way to read the sample, and how much of it becomes numbers.
struct Reading {
  Dialect dialect;
  std::size_t cells = 0;    ///< of a row
  std::size_t whole = 0;    ///< rows of numbers alone
  std::size_t numbers = 0;  ///< in all rows

  std::pair<std::size_t, std::size_t> score() const { return {whole, numbers}; }
};

Reading read_sample(const std::vector<Line>& sample, const Dialect& dialect) {
  std::map<std::size_t, Reading> by_cells;
  LineSplitter splitter(dialect.separator);
  for (const auto& line : sample) {
    const auto cells = splitter.split(line.text);
    const std::size_t numbers = count_numbers(cells, dialect.decimal);
    if (numbers < kFewestNumbers) continue;
    Reading& reading = by_cells[cells.size()];
    reading.cells = cells.size();
    const auto empty = static_cast<std::size_t>(std::ranges::count(cells, string_view()));
    reading.whole += numbers + empty == cells.size() ? 1U : 0U;
    reading.numbers += numbers;
  }
  Reading best{dialect};
  for (auto& [cells, reading] : by_cells) {
    reading.dialect = dialect;
    if (reading.score() > best.score()) best = reading;
  }
  return best;
}

Reading best_reading(const std::vector<Line>& sample) {
  Reading best;
  for (const auto& dialect : kDialects) {
    const Reading reading = read_sample(sample, dialect);
    if (reading.score() > best.score()) best = reading;
  }
  return best;
}

/// Reads the table line by line, in the best reading of its first lines.
class TableReader {
 public:
  explicit TableReader(string_view text) : text_(text) {
    LineReader lines(text);
    Line line;
    while (sample_.size() < kSample && lines.next(line)) sample_.push_back(line);
    reading_ = best_reading(sample_);
    splitter_ = LineSplitter(reading_.dialect.separator);
  }

  /// The line that an error is about.
  int line() const { return line_; }

  ForeignTable read() {
    if (text_.empty()) throw InputError("empty");
    find_first_row();
    require_columns();
    read_names();
    read_rows();
    drop_empty_last_columns();
    return std::move(table_);
  }

 private:
  char decimal() const { return reading_.dialect.decimal; }

  bool is_row(string_view line) {
    if (is_comment(line)) return false;
    const auto cells = splitter_.split(line);
    return cells.size() == reading_.cells && count_numbers(cells, decimal()) >= kFewestNumbers;
  }

  /// A row and one that is at least meant to be begin the data; a line of numbers in front of a
  /// line of names does not.
  void find_first_row() {
    for (std::size_t i = 0; i + 1 < sample_.size() && reading_.cells > 0; ++i) {
      if (!is_row(sample_[i].text)) continue;
      std::size_t next = i + 1;
      while (next + 1 < sample_.size() && is_passed_over(sample_[next].text)) ++next;
      const auto cells = splitter_.split(sample_[next].text);
      if (count_numbers(cells, decimal()) < kFewestNumbers) continue;
      first_ = i;
      return;
    }
    line_ = 1;
    throw InputError(
        "no two rows of two numbers or more; must be rows of numbers between commas, semicolons, "
        "tabs or blanks, without thousands separators");
  }

  void require_columns() {
    if (reading_.cells <= kMostRecordColumns) return;
    line_ = sample_[first_].number;
    throw InputError(fmt::format("{} cells; a table has at most {} columns", reading_.cells,
                                 kMostRecordColumns));
  }

  std::optional<std::vector<std::string>> names_in(string_view line) {
    const auto cells = splitter_.split_names(without_comment_mark(line));
    std::vector<std::string> names(cells.begin(), cells.end());
    while (!names.empty() && names.back().empty()) names.pop_back();
    // Columns at the end may have no names, and separators at the ends of rows make one more.
    const bool are_enough = names.size() + 1 >= reading_.cells ||
                            (reading_.dialect.separator != ' ' && names.size() >= kFewestNames &&
                             2 * names.size() >= reading_.cells);
    const auto empty = std::ranges::count(names, std::string());
    const bool is_numbers = std::ranges::all_of(names, [&](const std::string& name) {
      return name.empty() || parse_cell(name, decimal()).has_value();
    });
    if (!are_enough || names.size() > reading_.cells || empty > 1 || is_numbers) {
      return std::nullopt;
    }
    names.resize(reading_.cells);
    return names;
  }

  static bool are_units(const std::vector<std::string>& cells) {
    return std::ranges::all_of(cells, [](const std::string& cell) {
      const bool in_brackets = cell.starts_with('[') || cell.starts_with('(');
      return cell.empty() || in_brackets || is_canonical_unit(canonical_unit(cell));
    });
  }

  /// The line above `line` that is not blank.
  std::optional<std::size_t> above(std::size_t line) const {
    while (line > 0) {
      if (!is_blank_line(sample_[--line].text)) return line;
    }
    return std::nullopt;
  }

  void read_names() {
    std::vector<std::string> units;
    auto head = above(first_);
    auto names = head ? names_in(sample_[*head].text) : std::nullopt;
    const auto second = head ? above(*head) : std::nullopt;
    if (names && are_units(*names) && second) {
      if (auto upper = names_in(sample_[*second].text)) {
        assume(fmt::format("units are in line {}", sample_[*head].number));
        units = std::exchange(*names, std::move(*upper));
        head = second;
      }
    }
    for (std::size_t i = 0; i < reading_.cells; ++i) {
      ForeignColumn column;
      column.name = names && !(*names)[i].empty() ? (*names)[i] : fmt::format("column {}", i + 1);
      column.unit = units.empty() ? split_column_name(column.name).unit : canonical_unit(units[i]);
      table_.columns.push_back(std::move(column));
    }
    if (names) {
      assume(fmt::format("names are in line {}", sample_[*head].number));
    } else {
      assume("no header line; columns named column 1, column 2, ...");
    }
    const std::size_t preamble = names ? *head : first_;
    if (preamble > 0) assume(fmt::format("{} skipped at the beginning", counted(preamble, "line")));
  }

  static std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  }

  void assume(string_view sentence) { table_.assumptions.emplace_back(sentence); }

  void read_rows() {
    assume(fmt::format("cells are separated by {}", separator_name(reading_.dialect)));
    assume(fmt::format("numbers have a decimal {}", decimal() == ',' ? "comma" : "point"));
    LineReader lines(text_);
    Line line;
    Line short_row;
    while (lines.next(line)) {
      if (line.number < sample_[first_].number || is_passed_over(line.text)) continue;
      if (short_row.number > 0) require_cells(short_row);
      if (splitter_.split(line.text).size() < reading_.cells) {
        short_row = line;  // no fault yet, if it is the last one
      } else {
        read_row(line);
      }
    }
    if (short_row.number > 0) {
      assume(fmt::format("last line {} incomplete and ignored", short_row.number));
    }
  }

  void require_cells(const Line& line) {
    line_ = line.number;
    auto cells = splitter_.split(line.text);
    const bool ends_in_separator = cells.size() == reading_.cells + 1 && cells.back().empty();
    if (cells.size() == reading_.cells || ends_in_separator) return;
    throw InputError(fmt::format("{}; the rows above have {}, separated by {}",
                                 counted(cells.size(), "cell"), reading_.cells,
                                 separator_name(reading_.dialect)));
  }

  void read_row(const Line& line) {
    require_cells(line);
    const auto cells = splitter_.split(line.text).first(reading_.cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      ForeignColumn& column = table_.columns[i];
      if (column.is_text()) {
        column.texts.emplace_back(cells[i]);
      } else if (cells[i].empty()) {
        column.values.push_back(std::numeric_limits<double>::quiet_NaN());
      } else if (const auto value = parse_cell(cells[i], decimal())) {
        column.values.push_back(*value);
      } else if (holds_nothing(column) && !has_thousands_separators(cells[i], decimal())) {
        column.texts.assign(column.values.size(), "");
        column.texts.emplace_back(cells[i]);
        column.values.clear();
      } else {
        throw InputError(fmt::format(
            "column {} = {}: {}", arm::shown(column.name), arm::shown(cells[i]),
            has_thousands_separators(cells[i], decimal())
                ? "has thousands separators; write the number without them"
                : fmt::format("must be a number with a decimal {}, as in the rows above",
                              decimal() == ',' ? "comma" : "point")));
      }
    }
    table_.line_of_row.push_back(line.number);
  }

  /// Whether all cells of the column so far are empty.
  static bool holds_nothing(const ForeignColumn& column) {
    return !column.is_text() &&
           std::ranges::all_of(column.values, [](double value) { return std::isnan(value); });
  }

  /// Left by separators at the ends of the lines.
  void drop_empty_last_columns() {
    while (table_.columns.size() > 1) {
      const ForeignColumn& last = table_.columns.back();
      if (!holds_nothing(last) || !last.name.starts_with("column ")) return;
      table_.columns.pop_back();
    }
  }

  string_view text_;
  std::vector<Line> sample_;
  Reading reading_;
  LineSplitter splitter_{','};
  std::size_t first_ = 0;
  ForeignTable table_;
  int line_ = 1;
};

}  // namespace

std::size_t find_column(const ForeignTable& table, string_view name) {
  std::vector<std::string> names;
  for (const auto& column : table.columns) names.push_back(column.name);
  const auto place = column_place(names, name);
  if (!place) throw unknown_column(names, name);
  return *place;
}

int line_of(const ForeignTable& table, std::size_t row) {
  return row < table.line_of_row.size() ? table.line_of_row[row] : 0;
}

ForeignTable parse_foreign_table(string_view bytes, const std::string& file_name) {
  DecodedText text;
  try {
    text = decode_text(bytes);
  } catch (const InputError& error) {
    throw arm::located(error, file_name, 0);
  }
  TableReader reader(text.utf8);
  try {
    ForeignTable table = reader.read();
    if (text.encoding != string_view("UTF-8")) {
      table.assumptions.push_back(fmt::format("the text is {}", text.encoding));
    }
    return table;
  } catch (const InputError& error) {
    throw arm::located(error, file_name, reader.line());
  }
}

ForeignTable read_foreign_table(const std::filesystem::path& path) {
  return parse_foreign_table(measured::read_text_file(path, kLargestRecord_bytes),
                             arm::shown(path.string()));
}

}  // namespace flexarm::measured
