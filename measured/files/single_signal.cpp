#include "measured/files/single_signal.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/instrument_head.hpp"
#include "measured/files/sampling_settings.hpp"
#include "measured/files/universal_grid.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

constexpr std::size_t kFewestSingles = 10;
constexpr std::size_t kLongestHead = 100;
constexpr char kPoint = '.';

/// Whether text stands behind a cell in quotes, which a splitter leaves out.
bool has_text_behind_quotes(std::string_view line) {
  const auto quote = line.rfind('"');
  return quote != std::string_view::npos &&
         line.find_first_not_of(" \t,;\r", quote + 1) != std::string_view::npos;
}

/// The only cell of a line that is not empty, valid until the next line is split; nothing for
/// several and for none.
std::optional<std::string_view> single_cell(std::string_view line, LineSplitter& splitter) {
  if (has_text_behind_quotes(line)) return std::nullopt;
  std::optional<std::string_view> found;
  for (const auto cell : splitter.split(line)) {
    if (cell.empty()) continue;
    if (found) return std::nullopt;
    found = cell;
  }
  return found;
}

/// The number of a line that has no other cell.
std::optional<double> single_number(std::string_view line, LineSplitter& splitter) {
  const auto cell = single_cell(line, splitter);
  return cell ? parse_cell(*cell, kPoint) : std::nullopt;
}

bool is_no_line(std::string_view line) {
  return is_blank_line(line) || is_comment(line);
}

/// Where the samples at the end of the lines begin; nothing for less than ten.
std::optional<std::size_t> first_single(std::span<const TextLine> sample, LineSplitter& splitter) {
  std::size_t samples = 0;
  std::size_t first = sample.size();
  for (std::size_t i = sample.size(); i > 0; --i) {
    if (is_no_line(sample[i - 1].text)) continue;
    if (!single_number(sample[i - 1].text, splitter)) break;
    ++samples;
    first = i - 1;
  }
  if (samples < kFewestSingles || first > kLongestHead) return std::nullopt;
  return first;
}

std::optional<ForeignTable> table_between(std::span<const TextLine> sample, std::string_view text,
                                          char separator) {
  LineSplitter splitter(separator);
  const auto first = first_single(sample, splitter);
  if (!first) return std::nullopt;
  auto counted = counted_header(sample, splitter, kPoint);
  ForeignColumn signal;
  SamplingSettings settings;
  if (counted && counted->columns.size() == 1) {
    signal = std::move(counted->columns.front());
    settings = counted->settings;
  } else if (*first > 0) {
    settings = sampling_settings(sample.first(*first), separator, kPoint);
    std::size_t head = *first - 1;
    while (head > 0 && is_blank_line(sample[head].text)) --head;
    signal.name = single_cell(sample[head].text, splitter).value_or("");
    if (signal.name.find_first_of("=:") != std::string::npos) signal.name.clear();
    signal.unit = split_column_name(signal.name).unit;
  }
  if (signal.name.empty()) signal.name = "column 1";

  ForeignTable table;
  LineReader lines(text);
  TextLine line;
  while (lines.next(line)) {
    if (line.number < sample[*first].number || is_no_line(line.text)) continue;
    const auto number = single_number(line.text, splitter);
    if (!number) return std::nullopt;
    signal.values.push_back(*number);
    table.line_of_row.push_back(line.number);
  }
  table.assumptions = {fmt::format("one signal, {}", arm::shown(signal.name))};
  const std::size_t samples = signal.values.size();
  table.columns = {std::move(signal)};
  if (!settings.period_s) return table;
  table.assumptions.push_back(
      fmt::format("times begin at {} s and are {} s apart, as line {} tells", settings.start_s,
                  *settings.period_s, settings.line));
  table.columns.push_back(
      {"time [s]", "s", grid_points({settings.start_s, *settings.period_s}, samples)});
  table.columns.back().is_made = true;
  return table;
}

}  // namespace

std::optional<ForeignTable> single_signal_table(std::span<const TextLine> sample,
                                                std::string_view text) {
  for (const char separator : std::array{',', ';', '\t'}) {
    if (auto table = table_between(sample, text, separator)) return table;
  }
  return std::nullopt;
}

}  // namespace flexarm::measured
