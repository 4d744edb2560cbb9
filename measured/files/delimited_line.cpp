#include "measured/files/delimited_line.hpp"

#include "arm/ascii.hpp"
#include "measured/files/number_cell.hpp"
#include "measured/files/time_stamp.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <string>

namespace flexarm::measured {

using std::string_view;

namespace {

/// Whether the cell is one of the words and zeros: -1.#IND00, as Microsoft's C library prints NaN
/// and infinity in any number of digits.
bool is_printed_by_c(string_view cell, std::initializer_list<string_view> words) {
  if (cell.starts_with('-')) cell.remove_prefix(1);
  return std::ranges::any_of(words, [&](string_view front) {
    return cell.starts_with(front) &&
           cell.find_first_not_of('0', front.size()) == string_view::npos;
  });
}

}  // namespace

std::string in_lower_case(string_view text) {
  std::string letters(text);
  std::ranges::transform(letters, letters.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return letters;
}

string_view trimmed(string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

string_view separator_name(const Dialect& dialect) {
  switch (dialect.separator) {
    case '\t':
      return "tabs";
    case ';':
      return "semicolons";
    case ',':
      return "commas";
    default:
      return "blanks";
  }
}

/// Behind the quote that closes the one at `at`, and adds the cell.
std::size_t LineSplitter::quoted_end(string_view line, std::size_t at) {
  const std::size_t begin = at + 1;
  bool has_quotes = false;
  for (at = begin; at < line.size(); ++at) {
    if (line[at] != '"') continue;
    if (at + 1 == line.size() || line[at + 1] != '"') break;
    has_quotes = true;
    ++at;
  }
  at = std::min(at, line.size());
  const string_view content = line.substr(begin, at - begin);
  if (has_quotes) {
    std::string& single = rewritten_.emplace_back();
    for (std::size_t i = 0; i < content.size(); ++i) {
      if (content[i] == '"') ++i;
      single += content[i];
    }
    cells_.push_back(trimmed(single));
  } else {
    cells_.push_back(trimmed(content));
  }
  return std::min(at + 1, line.size());
}

/// Between blanks a date, its clock and AM or PM are one cell.
void LineSplitter::join_time_stamp() {
  if (cells_.size() < 2) return;
  const string_view last = cells_.back();
  string_view& before = cells_[cells_.size() - 2];
  const bool is_half = last == "AM" || last == "PM" || last == "am" || last == "pm";
  const bool is_clock = last.find(':') != string_view::npos && arm::is_digit(last.front()) &&
                        before.find(':') == string_view::npos;
  if (before.empty() || before.data() + before.size() > last.data()) return;
  const string_view both(before.data(),
                         static_cast<std::size_t>(last.data() + last.size() - before.data()));
  if ((!is_half && !is_clock) || both.find('"') != string_view::npos) return;
  if (!parse_time_stamp(both)) return;
  before = both;
  cells_.pop_back();
}

std::span<const string_view> LineSplitter::split(string_view line) {
  cells_.clear();
  rewritten_.clear();
  const bool by_blanks = separator_ == ' ';
  const auto ends_cell = [&](char c) { return by_blanks ? is_blank(c) : c == separator_; };
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && is_blank(line[at]) && (by_blanks || line[at] != separator_)) ++at;
    if (by_blanks && at == line.size()) break;
    if (at < line.size() && line[at] == '"') {
      at = quoted_end(line, at);
      while (at < line.size() && !ends_cell(line[at])) ++at;
    } else {
      const std::size_t begin = at;
      while (at < line.size() && !ends_cell(line[at])) ++at;
      cells_.push_back(trimmed(line.substr(begin, at - begin)));
      if (by_blanks) join_time_stamp();
    }
    if (at == line.size()) break;
    ++at;
  }
  return cells_;
}

std::span<const string_view> LineSplitter::split_names(string_view line) {
  const auto cells = split(line);
  if (separator_ != ' ' || !rewritten_.empty()) return cells;
  std::vector<string_view> names;
  char awaited = '\0';
  for (const auto cell : cells_) {
    const bool opens = cell.starts_with('(') || cell.starts_with('[');
    if ((awaited != '\0' || opens) && !names.empty()) {
      const char* begin = names.back().data();
      names.back() = {begin, static_cast<std::size_t>(cell.data() + cell.size() - begin)};
      if (opens) awaited = cell.front() == '(' ? ')' : ']';
    } else {
      names.push_back(cell);
    }
    if (awaited != '\0' && cell.find(awaited) != string_view::npos) awaited = '\0';
  }
  cells_ = std::move(names);
  return cells_;
}

std::optional<double> parse_cell(string_view cell, char decimal) {
  constexpr string_view kMinusSign = "\xe2\x88\x92";  // of word processors and spreadsheets
  if (cell.starts_with(kMinusSign)) {
    std::string plain(1, '-');
    plain += cell.substr(kMinusSign.size());
    return parse_cell(plain, decimal);
  }
  if (decimal == '.') return number_cell<double>(cell);
  std::array<char, 64> digits;
  if (cell.size() > digits.size() || cell.find('.') != string_view::npos) return std::nullopt;
  std::ranges::replace_copy(cell, digits.begin(), ',', '.');
  return number_cell<double>({digits.data(), cell.size()});
}

std::optional<std::complex<double>> parse_complex_cell(string_view cell, char decimal,
                                                       bool has_both) {
  constexpr std::size_t kLongest = 96;
  const bool may_be = cell.size() <= kLongest && cell.find_first_of("ij") != string_view::npos &&
                      cell.find_first_of("0123456789") != string_view::npos;
  if (!may_be) return std::nullopt;
  std::string text;
  std::ranges::copy_if(cell, std::back_inserter(text),
                       [](char c) { return !is_blank(c) && c != '*' && c != '(' && c != ')'; });
  if (const auto signs = text.find("+-"); signs != std::string::npos) text.erase(signs, 1);
  const auto unit = text.find_last_of("ij");
  text.erase(unit, 1);
  const auto is_sign = [&](std::size_t at) { return text[at] == '+' || text[at] == '-'; };
  std::size_t split = text.empty() ? 0 : text.size() - 1;  // of the real part, no exponent's sign
  while (split > 0 && (!is_sign(split) || text[split - 1] == 'e' || text[split - 1] == 'E')) {
    --split;
  }
  if (split == 0 && has_both) return std::nullopt;
  if (unit != text.size() && (split == 0 || unit != split + 1)) return std::nullopt;
  std::string imaginary = text.substr(split);
  if (imaginary == "+" || imaginary == "-") imaginary += '1';
  const auto re = split == 0 ? std::optional(0.0) : parse_cell(text.substr(0, split), decimal);
  const auto im = parse_cell(imaginary, decimal);
  if (!re || !im) return std::nullopt;
  return std::complex(*re, *im);
}

bool is_missing_number(string_view cell) {
  constexpr std::array<string_view, 35> kSigns = {
      ".",       "\\N",    "-",      "--",      "---",    "?",        "NA",
      "N/A",     "n/a",    "na",     "n.a.",    "N.A.",   "n.d.",     "k.A.",
      "k. A.",   "<NA>",   "NaT",    "None",    "none",   "null",     "NULL",
      "Null",    "#N/A",   "#NV",    "#NUM!",   "#ZAHL!", "#REF!",    "#BEZUG!",
      "#VALUE!", "#WERT!", "#NAME?", "#DIV/0!", "#NULL!", "nan(ind)", "-nan(ind)"};
  constexpr std::array<string_view, 10> kWords = {"nil",    "(null)",   "missing", "invalid",
                                                  "nodata", "no data",  "no_data", "bad",
                                                  "fehlt",  "bad input"};
  constexpr std::size_t kLongestWord = 9;
  const bool is_filled = cell.size() > 1 && cell.find_first_not_of('*') == string_view::npos;
  return cell.empty() || std::ranges::count(kSigns, cell) > 0 || is_filled ||
         is_printed_by_c(
             cell, {"1.#IND", "1.#QNAN", "1.#SNAN", "1,#IND", "1,#QNAN", "1,#SNAN", "1.#R"}) ||
         (cell.size() <= kLongestWord &&
          std::ranges::count(kWords, string_view(in_lower_case(cell))) > 0) ||
         is_over_range_sign(cell);
}

bool is_over_range_sign(string_view cell) {
  constexpr std::array<string_view, 10> kWords = {
      "ol",       "ovl",       "ovld",       "ovr",    "overload",
      "overflow", "overrange", "over range", "ovrflw", "\xe2\x88\x9e"};
  constexpr std::size_t kLongestWord = 11;
  if (is_printed_by_c(cell, {"1.#INF", "1,#INF"})) return true;
  if (cell.starts_with('+') || cell.starts_with('-')) cell.remove_prefix(1);
  return cell.size() <= kLongestWord &&
         std::ranges::count(kWords, string_view(in_lower_case(cell))) > 0;
}

bool has_thousands_separators(string_view cell, char decimal) {
  constexpr std::size_t kGroup = 3;
  constexpr string_view kDigits = "0123456789";
  for (const char mark : {',', '.', '\'', ' '}) {
    if (mark == decimal || cell.find(mark) == string_view::npos) continue;
    const auto end = cell.find(decimal);
    string_view whole = cell.substr(0, end);
    if (whole.starts_with('-') || whole.starts_with('+')) whole.remove_prefix(1);
    bool fits = true;
    bool is_first = true;
    std::string joined;
    while (fits) {
      const auto next = std::min(whole.find(mark), whole.size());
      const string_view group = whole.substr(0, next);
      fits = group.find_first_not_of(kDigits) == string_view::npos && !group.empty() &&
             (is_first ? group.size() <= kGroup && group != "0" : group.size() == kGroup);
      joined += group;
      is_first = false;
      if (next == whole.size()) break;
      whole.remove_prefix(next + 1);
    }
    if (end != string_view::npos) joined += cell.substr(end);
    if (fits && parse_cell(joined, decimal)) return true;
  }
  return false;
}

}  // namespace flexarm::measured
