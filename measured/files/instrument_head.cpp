#include "measured/files/instrument_head.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_mapping.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

/// A header is looked for in so many lines.
constexpr std::size_t kMostHeadLines = 100;
/// Settings beside samples take so many rows.
constexpr std::size_t kMostSettings = 60;

using Cells = std::vector<std::string>;

Cells cells_of(string_view line, LineSplitter& splitter) {
  const auto cells = splitter.split(line);
  return {cells.begin(), cells.end()};
}

std::size_t cell_place(const Cells& cells, bool (*is_it)(string_view)) {
  return static_cast<std::size_t>(
      std::ranges::find_if(cells, [&](const std::string& cell) { return is_it(cell); }) -
      cells.begin());
}

ForeignColumn named(const std::string& name, string_view unit) {
  ForeignColumn column;
  column.name = name;
  column.unit = canonical_unit(unit);
  if (!is_canonical_unit(column.unit)) column.unit = split_column_name(name).unit;
  return column;
}

bool is_number_at(const Cells& cells, std::size_t place, char decimal) {
  const auto number = place < cells.size() ? parse_cell(cells[place], decimal) : std::nullopt;
  return number && std::isfinite(*number);
}

/// A line of names with Start and Increment, their numbers in the line below and in no other.
std::optional<CountedHeader> header_of_two_lines(const Cells& names, std::size_t at,
                                                 std::span<const TextLine> lines,
                                                 LineSplitter& splitter, char decimal) {
  const std::size_t start = cell_place(names, is_start_name);
  const std::size_t period = cell_place(names, is_period_name);
  if (start == names.size() || period == names.size() || at + 2 >= lines.size()) {
    return std::nullopt;
  }
  const Cells below = cells_of(lines[at + 1].text, splitter);
  const Cells row = cells_of(lines[at + 2].text, splitter);
  const auto has_both = [&](const Cells& cells) {
    return is_number_at(cells, start, decimal) && is_number_at(cells, period, decimal);
  };
  if (!has_both(below) || has_both(row) || !(*parse_cell(below[period], decimal) > 0.0)) {
    return std::nullopt;
  }
  CountedHeader header;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == start || i == period) continue;
    header.columns.push_back(named(names[i], i < below.size() ? below[i] : ""));
  }
  header.settings = {*parse_cell(below[start], decimal), *parse_cell(below[period], decimal),
                     lines[at + 1].number};
  header.head = at;
  header.behind = at + 2;
  return header;
}

/// A line of names with `t0 = -0.1` and `tInc = 2e-3` behind them.
std::optional<CountedHeader> header_of_one_line(const Cells& names, std::size_t at,
                                                std::span<const TextLine> lines, char separator,
                                                char decimal) {
  CountedHeader header;
  header.settings = sampling_settings(lines.subspan(at, 1), separator, decimal);
  for (const auto& name : names) {
    if (name.find('=') != std::string::npos || name.empty()) continue;
    header.columns.push_back(named(name, ""));
  }
  const bool has_settings = header.columns.size() + 1 < names.size();
  if (!header.settings.period_s || !has_settings || header.columns.empty()) return std::nullopt;
  header.head = at;
  header.behind = at + 1;
  return header;
}

bool begins_with_letter(const Cells& cells) {
  return !cells.empty() && !plain_letters(cells.front().substr(0, 1)).empty();
}

/// A line of keys for each of the names, units and times of the signals.
std::optional<CountedHeader> header_of_keys(std::span<const TextLine> lines, LineSplitter& splitter,
                                            char decimal) {
  CountedHeader header;
  Cells names;
  Cells units;
  std::string time_unit = "s";
  for (std::size_t i = 0; i < std::min(lines.size(), kMostHeadLines); ++i) {
    const Cells cells = cells_of(lines[i].text, splitter);
    if (!begins_with_letter(cells)) {
      if (!names.empty() && !is_blank_line(lines[i].text)) break;
      continue;
    }
    const std::string key = plain_letters(cells.front());
    const Cells values(cells.begin() + 1, cells.end());
    header.behind = i + 1;
    if (key == "tracename" && !values.empty()) {
      names = values;
      header.head = i;
    }
    if (key == "vunit") units = values;
    if (key == "hunit" && !values.empty()) time_unit = canonical_unit(values.front());
    for (const auto& value : values) {
      if (key != "hresolution" || value.empty() || value == values.front()) continue;
      throw arm::InputError(
          fmt::format("HResolution {} and {}: signals of unlike sampling periods; save each in a "
                      "file of its own and join them with --join",
                      arm::shown(values.front()), arm::shown(value)));
    }
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  if (names.empty() || header.behind >= lines.size()) return std::nullopt;
  const auto first = std::ranges::find_if(
      lines.subspan(header.behind), [](const TextLine& line) { return !is_blank_line(line.text); });
  if (first == lines.end()) return std::nullopt;
  // Rows begin with an empty cell below the keys, with a time, or with the first signal.
  const Cells row = cells_of(first->text, splitter);
  const bool has_empty = row.front().empty();
  const auto filled = row.size() - static_cast<std::size_t>(std::ranges::count(row, std::string()));
  if (has_empty) header.columns.emplace_back();
  if (!has_empty && filled == names.size() + 1) header.columns.push_back(named("time", time_unit));
  for (std::size_t i = 0; i < names.size(); ++i) {
    header.columns.push_back(named(names[i], i < units.size() ? units[i] : ""));
  }
  const string_view line_of_names = lines[header.head].text;
  const auto mark = line_of_names.find_first_of(",;\t");
  header.settings = sampling_settings(
      lines.first(header.behind), mark == string_view::npos ? ' ' : line_of_names[mark], decimal);
  const auto seconds = conversion_of(kTime, time_unit);
  if (!seconds) {
    header.settings.period_s.reset();  // of a spectrum
  } else if (header.settings.period_s) {
    *header.settings.period_s *= *seconds;
    header.settings.start_s *= *seconds;
  }
  return header;
}

/// Source and units of the signals, as the keys of a block of settings state them.
struct Settings {
  std::string source;
  std::string unit;
  std::string time_unit;
};

void read_key(const Cells& cells, std::size_t block, Settings& settings) {
  const std::string key = plain_letters(cells[block]);
  const std::string value = block + 1 < cells.size() ? cells[block + 1] : "";
  if (value.empty()) return;
  if (key == "source" || key == "tracelabel") settings.source = value;
  if (key == "verticalunits" || key == "yunits") settings.unit = canonical_unit(value);
  if (key == "horizontalunits" || key == "xunits") settings.time_unit = canonical_unit(value);
}

bool begins_settings(string_view cell) {
  constexpr std::array<string_view, 6> kKeys = {"recordlength", "sampleinterval",  "model",
                                                "triggerpoint", "firmwareversion", "source"};
  return std::ranges::count(kKeys, plain_letters(cell)) > 0;
}

}  // namespace

std::optional<CountedHeader> counted_header(std::span<const TextLine> lines, LineSplitter& splitter,
                                            char decimal) {
  if (auto header = header_of_keys(lines, splitter, decimal)) return header;
  const std::size_t last = std::min(lines.size(), kMostHeadLines);
  for (std::size_t i = 0; i < last; ++i) {
    const string_view line = without_comment_mark(lines[i].text);
    const Cells names = cells_of(line, splitter);
    if (auto header = header_of_two_lines(names, i, lines, splitter, decimal)) return header;
    // Numbers alone are no names.
    if (line.find('=') == string_view::npos) continue;
    const std::size_t mark = line.find_first_of(",;\t");
    const char separator = mark == string_view::npos ? ' ' : line[mark];
    if (auto header = header_of_one_line(names, i, lines, separator, decimal)) return header;
  }
  return std::nullopt;
}

SettingsBeside settings_beside(std::span<const TextLine> rows, LineSplitter& splitter, char decimal,
                               std::vector<ForeignColumn>& columns) {
  SettingsBeside beside;
  if (rows.empty()) return beside;
  const Cells first = cells_of(rows.front().text, splitter);
  const Cells last = cells_of(rows.back().text, splitter);
  const auto is_empty_below = [&](std::size_t place) {
    return place < last.size() && last[place].empty();
  };
  for (std::size_t i = 0; i < columns.size() && i < first.size(); ++i) {
    if (!begins_settings(first[i]) || !is_empty_below(i)) continue;
    Settings settings;
    for (const auto& row : rows.first(std::min(rows.size(), kMostSettings))) {
      const Cells cells = cells_of(row.text, splitter);
      if (i < cells.size()) read_key(cells, i, settings);
    }
    const bool is_second = !beside.columns.empty();
    for (; i < columns.size() && is_empty_below(i); ++i) beside.columns.push_back(i);
    if (i + 1 >= columns.size() || !is_number_at(last, i, decimal)) continue;
    if (columns[i].name.starts_with("column ")) {
      columns[i].name = is_second ? settings.source + " time" : "time";
      columns[i].unit = settings.time_unit.empty() ? "s" : settings.time_unit;
    }
    ++i;
    if (columns[i].name.starts_with("column ") && !settings.source.empty()) {
      columns[i].name = settings.source;
      if (settings.unit.empty()) continue;
      beside.sentences.push_back(
          fmt::format("the instrument recorded {} in {}", settings.source, settings.unit));
    }
  }
  return beside;
}

}  // namespace flexarm::measured
