#include "measured/files/long_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/record_constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

constexpr string_view kSignalWords[] = {
    "signal",   "signalname",        "name",        "channel", "variable", "field",  "sensor",
    "quantity", "parameter",         "metric",      "tag",     "topic",    "series", "label",
    "kanal",    "signalbezeichnung", "messgroesse", "voie",    "grandeur"};
constexpr string_view kValueWords[] = {"value",   "values", "val",      "y",      "data",
                                       "reading", "wert",   "messwert", "valeur", "mesure"};
constexpr string_view kUnitWords[] = {"unit", "units", "einheit", "unite"};

/// Places of the columns of a table in long form.
struct LongForm {
  std::size_t times = 0;
  std::size_t names = 0;
  std::size_t values = 0;
  std::optional<std::size_t> units;
  std::vector<std::string> signals;  ///< the name in each row
};

/// The only column with one of the words as its name, of texts or of numbers.
std::optional<std::size_t> only_place(const ForeignTable& table, std::span<const string_view> words,
                                      bool of_texts) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const ForeignColumn& column = table.columns[i];
    const std::string base = split_column_name(column.name).base;
    const std::string letters = plain_letters(string_view(base).substr(base.rfind('.') + 1));
    if (column.is_text() != of_texts || std::ranges::count(words, letters) == 0) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

/// "channel 1" for each 1 in a column of numbers of channels; empty for other numbers.
std::vector<std::string> numbered_signals(const ForeignColumn& column) {
  constexpr double kMost = 1e6;
  const std::string base = split_column_name(column.name).base;
  std::vector<std::string> signals;
  for (const double number : column.values) {
    if (!(number >= 0.0 && number < kMost && number == std::floor(number))) return {};
    signals.push_back(fmt::format("{} {:.0f}", base.substr(base.rfind('.') + 1), number));
  }
  return signals;
}

std::optional<LongForm> long_form_of(const ForeignTable& table) {
  auto names = only_place(table, kSignalWords, true);
  const bool is_numbered = !names;
  if (is_numbered) names = only_place(table, kSignalWords, false);
  const auto values = only_place(table, kValueWords, false);
  const auto time = std::ranges::find_if(table.columns, is_time_column);
  if (!names || !values || time == table.columns.end()) return std::nullopt;
  LongForm form{
      static_cast<std::size_t>(time - table.columns.begin()), *names, *values,
      only_place(table, kUnitWords, true),
      is_numbered ? numbered_signals(table.columns[*names]) : table.columns[*names].texts};
  const std::size_t rows = form.signals.size();
  const std::set<string_view> signals(form.signals.begin(), form.signals.end());
  // Numbers are channels where most times have several.
  std::set<double> times;
  std::ranges::copy_if(time->values, std::inserter(times, times.end()),
                       [](double at) { return !std::isnan(at); });
  const bool is_repeated = 2 * signals.size() <= rows && signals.size() <= kMostRecordColumns &&
                           (!is_numbered || 4 * times.size() <= 3 * rows);
  if (form.times == form.values || !is_repeated || time->values.size() != rows ||
      table.columns[*values].values.size() != rows) {
    return std::nullopt;
  }
  return form;
}

/// "line 3", or "row 2" of a file without lines.
std::string row_text(const ForeignTable& table, std::size_t row) {
  return table.line_of_row.empty() ? fmt::format("row {}", row + 1)
                                   : fmt::format("line {}", line_of(table, row));
}

}  // namespace

ForeignTable without_long_form(ForeignTable table) {
  const auto form = long_form_of(table);
  if (!form) return table;
  const auto& times = table.columns[form->times];
  const auto& texts = form->signals;
  const auto& values = table.columns[form->values];
  ForeignTable made;
  made.assumptions = std::move(table.assumptions);
  std::map<double, std::size_t> row_at;
  for (const double time : times.values) {
    if (!std::isnan(time)) row_at.emplace(time, 0);
  }
  ForeignColumn time{times.name, times.unit, {}};
  time.is_stamp = times.is_stamp;
  time.start = times.start;
  for (auto& [at, row] : row_at) {
    row = time.values.size();
    time.values.push_back(at);
  }
  made.columns.push_back(std::move(time));
  if (!table.line_of_row.empty()) made.line_of_row.resize(row_at.size());
  std::map<string_view, std::size_t> column_of;
  std::vector<std::vector<bool>> is_set;
  for (std::size_t row = 0; row < texts.size(); ++row) {
    if (std::isnan(times.values[row])) continue;
    const auto [found, is_new] = column_of.emplace(texts[row], made.columns.size());
    std::string unit = form->units ? canonical_unit(table.columns[*form->units].texts[row]) : "";
    if (unit.empty()) unit = values.unit;
    const std::string of_name = split_column_name(texts[row]).unit;
    if (unit.empty()) unit = of_name;
    if (is_new) {
      made.columns.push_back({texts[row], unit, std::vector<double>(row_at.size(), kUnknown)});
      is_set.emplace_back(row_at.size(), false);
    }
    ForeignColumn& column = made.columns[found->second];
    for (const std::string& other : {column.unit, of_name}) {
      if (unit == other || other.empty()) continue;
      throw InputError(fmt::format("{}: in {}, and in {} in {}; must be in one unit",
                                   arm::shown(texts[row]), arm::shown(other), arm::shown(unit),
                                   row_text(table, row)));
    }
    const std::size_t at = row_at[times.values[row]];
    if (is_set[found->second - 1][at]) {
      throw InputError(fmt::format("{}: a second value at {} = {} in {}; must have one at a time",
                                   arm::shown(texts[row]), arm::shown(times.name),
                                   times.values[row], row_text(table, row)));
    }
    is_set[found->second - 1][at] = true;
    column.values[at] = values.values[row];
    if (!made.line_of_row.empty() && made.line_of_row[at] == 0) {
      made.line_of_row[at] = line_of(table, row);
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 1; i < made.columns.size(); ++i) names.push_back(made.columns[i].name);
  made.assumptions.push_back(fmt::format(
      "rows of {}, {} and {} are taken as columns: {}", arm::shown(times.name),
      arm::shown(table.columns[form->names].name), arm::shown(values.name), shown_names(names)));
  return made;
}

}  // namespace flexarm::measured
