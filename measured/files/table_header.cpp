#include "measured/files/table_header.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/time_stamp.hpp"
#include "measured/files/unit.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;
using Names = std::vector<std::string>;

/// A line of names in front of rows of more cells has at least so many, and half as many as cells.
constexpr std::size_t kFewestNames = 3;

/// Whether both are units of one quantity.
bool are_of_one_quantity(string_view unit, string_view other) {
  const auto is_of = [](string_view si_unit, string_view name) {
    const auto units = units_for(si_unit);
    return std::ranges::count(units, name, &Unit::name) > 0 ||
           other_unit_scale(si_unit, name).has_value();
  };
  constexpr std::array<string_view, 7> kSiUnits = {"s", "N m", "rad", "rad/s", "m/s^2", "m", "1"};
  return std::ranges::any_of(
      kSiUnits, [&](string_view si_unit) { return is_of(si_unit, unit) && is_of(si_unit, other); });
}

bool is_known_unit(const std::string& cell) {
  return !cell.empty() && is_canonical_unit(canonical_unit(cell));
}

bool are_units(const Names& cells) {
  return std::ranges::all_of(cells, [](const std::string& cell) {
    return cell.empty() || cell.starts_with('[') || cell.starts_with('(') || is_known_unit(cell);
  });
}

/// Whether a name is of what counts rows.
bool names_count(string_view name) {
  constexpr std::array<string_view, 15> kCounts = {"",       "n",     "no",    "nr",      "i",
                                                   "k",      "id",    "index", "idx",     "row",
                                                   "sample", "count", "point", "counter", "line"};
  return std::ranges::count(kCounts, plain_letters(name)) > 0;
}

/// Whether the numbers are more than two in even steps up.
bool rise_evenly(std::span<const double> numbers) {
  constexpr double kAlike = 1e-3;
  if (numbers.size() < 3) return false;
  const double step = (numbers.back() - numbers.front()) / static_cast<double>(numbers.size() - 1);
  return step > 0.0 && std::ranges::adjacent_find(numbers, [&](double before, double number) {
                         return !(std::abs(number - before - step) <= kAlike * step);
                       }) == numbers.end();
}

class HeaderReader {
 public:
  HeaderReader(std::span<const TextLine> sample, const TableReading& reading, std::size_t first,
               int& line)
      : sample_(sample), reading_(reading), first_(first), line_(line) {}

  TableHeader read() {
    auto head = above(first_);
    auto names = head ? names_in(*head) : std::nullopt;
    if (head) require_one_use_of_comma(*head, names.has_value());
    if (!names) {
      TableHeader header{std::vector<ForeignColumn>(reading_.cells),
                         {"no header line; columns named column 1, column 2, ..."}};
      add_preamble(header, first_);
      return header;
    }
    std::size_t top = *head;
    Names units(reading_.cells);
    TableHeader header;
    if (const auto second = above(*head)) {
      auto upper = names_in(*second);
      if (upper && are_units(*names)) {
        header.sentences.push_back(fmt::format("units are in line {}", sample_[*head].number));
        line_ = sample_[*head].number;
        units = std::exchange(*names, std::move(*upper));
        head = top = *second;
      } else if (upper && are_units(*upper) && std::ranges::count_if(*upper, is_known_unit) > 1) {
        header.sentences.push_back(fmt::format("units are in line {}", sample_[*second].number));
        line_ = sample_[*second].number;
        units = std::move(*upper);
        top = *second;
      }
    }
    for (std::size_t i = 0; i < names->size(); ++i) {
      header.columns.push_back(column_of((*names)[i], units[i]));
    }
    header.sentences.push_back(fmt::format("names are in line {}", sample_[*head].number));
    add_preamble(header, top);
    line_ = sample_[first_].number;
    require_whole_stamps(*names);
    give_names_to_last(*head, header);
    return header;
  }

 private:
  std::optional<Names> names_in(std::size_t line) {
    const auto cells = splitter_.split_names(without_comment_mark(sample_[line].text));
    Names names(cells.begin(), cells.end());
    while (!names.empty() && names.back().empty()) names.pop_back();
    join_date_and_time(names);
    // Columns at the end may have no names, and separators at the ends of rows make one more.
    const bool are_enough = names.size() + 1 >= reading_.cells ||
                            (reading_.dialect.separator != ' ' && names.size() >= kFewestNames &&
                             2 * names.size() >= reading_.cells);
    const auto empty = std::ranges::count(names, std::string());
    const bool is_numbers = std::ranges::all_of(names, [&](const std::string& name) {
      return name.empty() || parse_cell(name, reading_.dialect.decimal).has_value();
    });
    const bool is_clock = std::ranges::count_if(names, [](const std::string& name) {
                            return name.find(':') != std::string::npos && parse_time_stamp(name);
                          }) >= 2;
    if (!are_enough || names.size() > reading_.cells || empty > 1 || is_numbers || is_clock) {
      return std::nullopt;
    }
    names.resize(reading_.cells);
    return names;
  }

  /// The line above `line` that is not blank.
  std::optional<std::size_t> above(std::size_t line) const {
    while (line > 0) {
      if (!is_blank_line(sample_[--line].text)) return line;
    }
    return std::nullopt;
  }

  /// Between blanks the rows have a date and its clock in one cell.
  void join_date_and_time(Names& names) {
    if (reading_.dialect.separator != ' ' || names.size() != reading_.cells + 1) return;
    const auto row = splitter_.split(sample_[first_].text);
    const auto stamp = row.empty() ? std::nullopt : parse_time_stamp(row.front());
    if (!stamp || !stamp->has_date() || !stamp->clock_ns) return;
    names[0] += " " + names[1];
    names.erase(names.begin() + 1);
  }

  ForeignColumn column_of(const std::string& name, const std::string& unit) const {
    ForeignColumn column;
    column.name = name;
    column.unit = canonical_unit(unit);
    const std::string own = split_column_name(name).unit;
    const bool is_fault =
        is_canonical_unit(own) && is_canonical_unit(column.unit) && own != column.unit &&
        (name.find('[') != std::string::npos || are_of_one_quantity(own, column.unit));
    if (is_fault) {
      throw InputError(
          fmt::format("column {}: in {} by its name, in {} by the line of units; must "
                      "be the same",
                      arm::shown(name), own, column.unit));
    }
    if (column.unit.empty()) column.unit = own;
    return column;
  }

  static void add_preamble(TableHeader& header, std::size_t lines) {
    if (lines == 0) return;
    header.sentences.push_back(
        fmt::format("{} line{} skipped at the beginning", lines, lines == 1 ? "" : "s"));
  }

  /// Seconds behind a decimal comma would be a column of their own.
  void require_whole_stamps(const Names& names) {
    const auto row = splitter_.split(sample_[first_].text);
    const bool has_more_cells = names.back().empty() && !row.back().empty();
    if (reading_.dialect.separator != ',' || !has_more_cells || !parse_time_stamp(row[0])) return;
    throw InputError(
        fmt::format("{}: time stamps with a decimal comma between commas; put the time stamps "
                    "in quotes, or write them with a decimal point",
                    arm::shown(row[0])));
  }

  /// Numbers with a decimal comma between commas make two cells each: 0,22,0,0600 below two names.
  void require_one_use_of_comma(std::size_t head, bool is_header) {
    if (reading_.dialect != Dialect{',', '.'}) return;
    Names names;
    for (const auto cell : splitter_.split(sample_[head].text)) names.emplace_back(cell);
    while (!names.empty() && names.back().empty()) names.pop_back();
    const bool are_names = !names.empty() && std::ranges::none_of(names, [](const auto& name) {
      return parse_cell(name, '.').has_value();
    });
    const std::size_t cells = reading_.cells;
    if (!are_names || names.size() >= cells || 2 * names.size() < cells) return;
    bool has_leading_zero = false;
    for (const auto& text : sample_.subspan(first_)) {
      const auto row = splitter_.split(text.text);
      if (is_comment(text.text) || row.size() != cells) continue;
      for (const auto cell : row) {
        if (cell.empty() || cell.find_first_of(".:\"") != string_view::npos) return;
        has_leading_zero = has_leading_zero || (cell.size() > 1 && cell.front() == '0');
      }
    }
    // Whole numbers under a title are no decimals.
    if (!has_leading_zero && !(is_header && cells == 2 * names.size())) return;
    line_ = sample_[first_].number;
    throw InputError(
        fmt::format("{} cells below {} names: the comma is both separator and decimal mark; save "
                    "with semicolons, or with decimal points",
                    cells, names.size()));
  }

  /// The numbers of a column in the sample.
  std::vector<double> numbers_of(std::size_t column) {
    std::vector<double> numbers;
    for (const auto& text : sample_.subspan(first_)) {
      const auto row = splitter_.split(text.text);
      if (is_comment(text.text) || row.size() != reading_.cells) continue;
      numbers.push_back(parse_cell(row[column], reading_.dialect.decimal).value_or(kUnknown));
    }
    return numbers;
  }

  /// Whether the first cell of each row is in quotes, and no other.
  bool has_quoted_rows() {
    return std::ranges::all_of(sample_.subspan(first_), [&](const TextLine& text) {
      return is_comment(text.text) || splitter_.split(text.text).size() != reading_.cells ||
             (trimmed(text.text).starts_with('"') && std::ranges::count(text.text, '"') == 2);
    });
  }

  void give_names_to_last(std::size_t head, TableHeader& header) {
    auto& columns = header.columns;
    const auto row = splitter_.split(sample_[first_].text);
    if (columns.size() < 3 || !columns.back().name.empty() || row.back().empty()) return;
    if (names_count(columns.front().name) || parse_time_stamp(row.front())) return;
    const std::size_t cells =
        splitter_.split_names(without_comment_mark(sample_[head].text)).size();
    const auto numbers = numbers_of(0);
    const bool rises = rise_evenly(numbers);
    const bool counts = rises && numbers[1] - numbers[0] == 1.0;
    if (cells + 1 == reading_.cells &&
        (has_quoted_rows() || (counts && (numbers[0] == 1.0 || rise_evenly(numbers_of(1)))))) {
      std::ranges::rotate(columns, columns.end() - 1);
      header.sentences.push_back("names are those of the last columns; the first numbers the rows");
      return;
    }
    if (!rises || std::ranges::any_of(columns, is_time_column)) return;
    const std::string name = plain_letters(quantity_name(columns.front().name));
    const bool is_quantity = std::ranges::any_of(quantity_words(), [&](const QuantityWords& words) {
      return std::ranges::count(words.words, name) > 0;
    });
    if (!is_quantity) return;
    throw InputError(
        fmt::format("column {} increases evenly, as a time does, and the last column has no name; "
                    "the header must name each column",
                    arm::shown(columns.front().name)));
  }

  std::span<const TextLine> sample_;
  TableReading reading_;
  std::size_t first_;
  int& line_;
  LineSplitter splitter_{reading_.dialect.separator};
};

}  // namespace

TableHeader read_table_header(std::span<const TextLine> sample, const TableReading& reading,
                              std::size_t first, int& line) {
  return HeaderReader(sample, reading, first, line).read();
}

}  // namespace flexarm::measured
