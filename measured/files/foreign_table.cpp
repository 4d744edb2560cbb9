#include "measured/files/foreign_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_builder.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/instrument_head.hpp"
#include "measured/files/labview_text.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/sampling_settings.hpp"
#include "measured/files/single_signal.hpp"
#include "measured/files/table_header.hpp"
#include "measured/files/table_reading.hpp"
#include "measured/files/text_encoding.hpp"
#include "measured/files/text_file.hpp"
#include "measured/files/text_lines.hpp"
#include "measured/files/thousands_marks.hpp"
#include "measured/files/time_stamp.hpp"
#include "measured/files/unit.hpp"
#include "measured/files/universal_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

/// So many lines tell how a file is written.
constexpr std::size_t kSample = 2000;

bool is_passed_over(string_view line) {
  return is_blank_line(line) || is_comment(line);
}

/// Reads the table line by line, in the best reading of its first lines.
class TableReader {
 public:
  explicit TableReader(string_view text) : text_(text) {
    LineReader lines(text);
    TextLine line;
    while (sample_.size() < kSample && lines.next(line)) sample_.push_back(line);
    reading_ = best_table_reading(sample_);
    splitter_ = LineSplitter(reading_.dialect.separator);
  }

  /// The line that an error is about.
  int line() const { return line_; }

  ForeignTable read() {
    if (text_.empty()) throw InputError("empty");
    if (auto single = single_signal_table(sample_, text_)) return *std::move(single);
    counted_ = counted_header(sample_, splitter_, decimal());
    find_first_row();
    require_columns();
    read_names();
    read_rows();
    add_times();
    return std::move(table_);
  }

 private:
  char decimal() const { return reading_.dialect.decimal; }

  bool is_row(string_view line) {
    if (is_comment(line)) return false;
    const auto cells = splitter_.split(line);
    return cells.size() == reading_.cells && count_numbers(cells, decimal()) >= kFewestNumbers;
  }

  /// A row with some empty cells.
  bool is_incomplete_row(string_view line) {
    if (is_comment(line) || reading_.dialect.separator == ' ') return false;
    const auto cells = splitter_.split(line);
    const std::size_t numbers = count_numbers(cells, decimal());
    const auto missing = std::ranges::count_if(cells, [&](string_view cell) {
      return is_missing_number(cell) && !parse_cell(cell, decimal());
    });
    return cells.size() == reading_.cells && numbers > 0 &&
           numbers + static_cast<std::size_t>(missing) == cells.size();
  }

  /// A row with a number beside time stamps.
  bool is_row_of_numbers(string_view line) {
    return is_row(line) && std::ranges::any_of(splitter_.split(line), [&](string_view cell) {
             return parse_cell(cell, decimal()).has_value();
           });
  }

  /// Tells what a column holds in the last rows of the sample, which are no head.
  enum class LastCells { empty, numbers, texts };

  /// Goes back from the end of the sample up to the first line that is no row.
  std::vector<LastCells> last_cells() {
    constexpr std::size_t kRows = 16;
    std::vector<LastCells> last(reading_.cells, LastCells::empty);
    std::size_t rows = 0;
    for (std::size_t i = sample_.size(); i > 0 && rows < kRows; --i) {
      const string_view line = sample_[i - 1].text;
      if (is_passed_over(line)) continue;
      if (!is_row_of_numbers(line) && !is_incomplete_row(line)) {
        if (rows > 0) break;
        continue;  // cut off
      }
      ++rows;
      const auto cells = splitter_.split(line);
      for (std::size_t k = 0; k < last.size(); ++k) {
        if (is_missing_number(cells[k])) continue;
        const bool is_number = count_numbers(cells.subspan(k, 1), decimal()) > 0;
        last[k] = is_number && last[k] != LastCells::texts ? LastCells::numbers : LastCells::texts;
      }
    }
    return last;
  }

  /// Whether a row has no text where the last rows have numbers, and no text that is the name of a
  /// number where they have none: "Vertical Scale,1,0.5" is a line of a head.
  bool is_like(string_view row, const std::vector<LastCells>& last) {
    const auto cells = splitter_.split(row);
    for (std::size_t k = 0; k < last.size(); ++k) {
      const bool is_number = count_numbers(cells.subspan(k, 1), decimal()) > 0;
      if (is_number || is_missing_number(cells[k])) continue;
      if (last[k] == LastCells::numbers) return false;
      const bool is_name = last[k] == LastCells::empty && k + 1 < last.size() &&
                           last[k + 1] == LastCells::numbers && !cells[k + 1].empty();
      if (is_name) return false;
    }
    return true;
  }

  /// A row and one that is at least meant to be begin the data; a line of numbers in front of a
  /// line of names does not, nor does one of settings.
  void find_first_row() {
    const std::size_t from = counted_ ? counted_->behind : 0;
    const auto last = last_cells();
    for (std::size_t i = from; i + 1 < sample_.size() && reading_.cells > 0; ++i) {
      if (!is_row(sample_[i].text) || !is_like(sample_[i].text, last)) continue;
      std::size_t next = i + 1;
      while (next + 1 < sample_.size() && is_passed_over(sample_[next].text)) ++next;
      const auto cells = splitter_.split(sample_[next].text);
      const bool has_numbers = count_numbers(cells, decimal()) >= kFewestNumbers;
      if (!has_numbers && !is_incomplete_row(sample_[next].text)) continue;
      first_ = i;
      for (std::size_t before = i; before > from; --before) {
        const string_view line = sample_[before - 1].text;
        if (is_passed_over(line)) continue;
        if (!is_incomplete_row(line) && !is_row_of_numbers(line)) break;
        first_ = before - 1;
      }
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

  void read_names() {
    if (counted_) {
      columns_ = counted_->columns;
      columns_.resize(reading_.cells);
      assume(fmt::format("names are in line {}", sample_[counted_->head].number));
    } else {
      auto header = read_table_header(sample_, reading_, first_, line_);
      columns_ = std::move(header.columns);
      std::ranges::move(header.sentences, std::back_inserter(assumptions_));
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].name.empty()) columns_[i].name = fmt::format("column {}", i + 1);
    }
    auto beside =
        settings_beside(std::span(sample_).subspan(first_), splitter_, decimal(), columns_);
    beside_ = std::move(beside.columns);
    if (!beside_.empty()) {
      assume(fmt::format("settings of the instrument are in columns {} to {}", beside_.front() + 1,
                         beside_.back() + 1));
    }
    for (const auto& sentence : beside.sentences) assume(arm::shown(sentence, 200));
  }

  static std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  }

  void assume(string_view sentence) { assumptions_.emplace_back(sentence); }

  void read_rows() {
    assume(fmt::format("cells are separated by {}", separator_name(reading_.dialect)));
    assume(fmt::format("numbers have a decimal {}", decimal() == ',' ? "comma" : "point"));
    ColumnBuilder builder(columns_, decimal());
    for (const std::size_t column : beside_) builder.take_as_text(column);
    ThousandsMarks marks(reading_.cells, reading_.dialect);
    LineReader lines(text_);
    TextLine line;
    TextLine short_row;
    while (lines.next(line)) {
      if (line.number < sample_[first_].number || is_passed_over(line.text)) continue;
      if (short_row.number > 0) require_cells(short_row);
      if (splitter_.split(line.text).size() < reading_.cells) {
        short_row = line;  // no fault yet, if it is the last one
      } else {
        require_cells(line);
        const auto cells = splitter_.split(line.text).first(reading_.cells);
        builder.add_row(cells, line.number);
        marks.add_row(cells, line.number);
      }
    }
    if (short_row.number > 0) {
      assume(fmt::format("last line {} incomplete and ignored", short_row.number));
    }
    table_ = builder.finish();
    if (const auto mark = marks.doubtful()) {
      line_ = mark->line;
      throw InputError(fmt::format("column {} = {}: {}", arm::shown(columns_[mark->column].name),
                                   arm::shown(mark->cell), mark->fault));
    }
    std::ranges::move(table_.assumptions, std::back_inserter(assumptions_));
  }

  void require_cells(const TextLine& line) {
    line_ = line.number;
    auto cells = splitter_.split(line.text);
    const bool ends_in_separator = cells.size() == reading_.cells + 1 && cells.back().empty();
    if (cells.size() == reading_.cells || ends_in_separator) return;
    throw InputError(fmt::format("{}; the rows above have {}, separated by {}",
                                 counted(cells.size(), "cell"), reading_.cells,
                                 separator_name(reading_.dialect)));
  }

  /// Times of a start and a period in front of the samples, where no column has any.
  void add_times() {
    SamplingSettings settings;
    if (!std::ranges::any_of(table_.columns, is_time_column)) {
      settings = counted_ ? counted_->settings
                          : sampling_settings(std::span(sample_).first(first_),
                                              reading_.dialect.separator, decimal());
    }
    if (settings.period_s) {
      assume(fmt::format("times begin at {} s and are {} s apart, as line {} tells",
                         settings.start_s, *settings.period_s, settings.line));
      ForeignColumn times{
          "time [s]", "s",
          grid_points({settings.start_s, *settings.period_s}, table_.line_of_row.size())};
      times.is_made = true;
      table_.columns.push_back(std::move(times));
    }
    table_.assumptions = std::move(assumptions_);
  }

  string_view text_;
  std::vector<TextLine> sample_;
  TableReading reading_;
  LineSplitter splitter_{','};
  std::optional<CountedHeader> counted_;
  std::size_t first_ = 0;
  std::vector<ForeignColumn> columns_;  ///< names and units
  std::vector<std::size_t> beside_;     ///< columns of settings beside the samples
  std::vector<std::string> assumptions_;
  ForeignTable table_;
  int line_ = 1;
};

/// Whether the name of a column tells a quantity.
bool names_quantity(const ForeignColumn& column) {
  const std::string name = plain_letters(quantity_name(column.name));
  return std::ranges::any_of(quantity_words(), [&](const QuantityWords& words) {
    return std::ranges::count(words.words, name) > 0;
  });
}

/// The first text with a digit, of a column of texts that is by its name numbers.
std::optional<std::size_t> row_of_no_number(const ForeignColumn& column) {
  if (!column.is_text() || !names_quantity(column)) return std::nullopt;
  const auto found = std::ranges::find_if(column.texts, [](const std::string& cell) {
    return cell.find_first_of("0123456789") != std::string::npos && !parse_cell(cell, '.') &&
           !parse_time_stamp(cell);
  });
  if (found == column.texts.end()) return std::nullopt;
  return static_cast<std::size_t>(found - column.texts.begin());
}

}  // namespace

bool is_time_column(const ForeignColumn& column) {
  if (column.is_text()) return false;
  const auto words = quantity_words();
  const auto time = std::ranges::find(words, string_view("time"), &QuantityWords::quantity);
  const bool is_named =
      std::ranges::count(time->words, plain_letters(quantity_name(column.name))) > 0;
  const auto units = units_for("s");
  return is_named || column.is_stamp ||
         std::ranges::count(units, string_view(column.unit), &Unit::name) > 0 ||
         other_unit_scale("s", column.unit).has_value();
}

bool ForeignColumn::holds_nothing() const {
  return !is_text() && std::ranges::all_of(values, [](double value) { return std::isnan(value); });
}

std::vector<std::string> stray_texts(const ForeignTable& table) {
  std::vector<std::string> sentences;
  for (const auto& column : table.columns) {
    const bool is_alone = !column.stray.empty();
    const auto row = is_alone ? column.stray_row : row_of_no_number(column);
    if (!row) continue;
    const std::string place = table.line_of_row.empty()
                                  ? fmt::format("sample {}", *row + 1)
                                  : fmt::format("line {}", line_of(table, *row));
    sentences.push_back(fmt::format(
        "{} = {} in {}: no number, {}", arm::shown(column.name), arm::shown(column.texts[*row]),
        place,
        is_alone
            ? "as its other cells are; write the number, or leave the cell empty for a missing "
              "sample"
            : "nor are other cells of the column; write them as numbers, with the decimal mark "
              "of the other columns"));
  }
  return sentences;
}

std::size_t find_column(const ForeignTable& table, string_view name) {
  const std::vector<std::string> names = column_names(table.columns);
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
  if (is_labview_text(text.utf8)) return parse_labview_text(text.utf8, file_name);
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
