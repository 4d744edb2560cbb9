#include "measured/files/sampling_settings.hpp"

#include "arm/ascii.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::measured {

namespace {

using std::string_view;

constexpr std::array<string_view, 22> kPeriodNames = {"sampleinterval",
                                                      "samplinginterval",
                                                      "sampleperiod",
                                                      "samplingperiod",
                                                      "sampletime",
                                                      "samplingtime",
                                                      "increment",
                                                      "xincrement",
                                                      "xincr",
                                                      "tinc",
                                                      "timeincrement",
                                                      "timestep",
                                                      "deltax",
                                                      "deltat",
                                                      "dt",
                                                      "dx",
                                                      "hresolution",
                                                      "abtastintervall",
                                                      "abtastzeit",
                                                      "abtastperiode",
                                                      "timeinterval",
                                                      "periodeechantillonnage"};
constexpr std::array<string_view, 8> kRateNames = {
    "samplerate", "samplingrate", "samplefrequency", "samplingfrequency",
    "fs",         "abtastrate",   "abtastfrequenz",  "frequenceechantillonnage"};
constexpr std::array<string_view, 7> kStartNames = {"start",   "hoffset", "x0",    "t0",
                                                    "xorigin", "xzero",   "xstart"};

bool is_one_of(std::span<const string_view> names, string_view words) {
  return std::ranges::count(names, words) > 0;
}

/// Letters and digits in lower case, "x0" of "X0"; empty for what is no such name.
std::string setting_name_of(string_view words) {
  constexpr std::size_t kLongestSetting = 40;
  if (words.empty() || !arm::is_letter(words.front()) || words.size() > kLongestSetting) return "";
  const std::string base = split_column_name(words).base;
  if (base == "Ts") return "sampletime";  // "ts" may be a time stamp
  std::string name = plain_letters(base);
  for (const char digit : {'0'}) {
    if (base.ends_with(digit)) name += digit;
  }
  return name;
}

/// A number and what stands behind it, its unit.
struct Setting {
  double value = 0.0;
  std::string unit;
};

std::optional<Setting> setting_in(string_view text, char decimal) {
  text = trimmed(text);
  if (const auto colon = text.rfind(':'); colon != string_view::npos) {
    text = trimmed(text.substr(colon + 1));  // Analog:1.00E-09
  }
  constexpr std::size_t kLongest = 40;
  std::size_t size = text.size();
  if (size > kLongest) return std::nullopt;
  while (size > 0) {
    if (const auto value = parse_cell(trimmed(text.substr(0, size)), decimal)) {
      return Setting{*value, canonical_unit(trimmed(text.substr(size)))};
    }
    --size;
  }
  return std::nullopt;
}

/// Seconds in one of the unit; empty for a unit of no time.
std::optional<double> seconds_in(const std::string& unit) {
  if (unit.empty()) return 1.0;
  for (const auto& known : units_for("s")) {
    if (known.name == unit) return known.to_si(1.0);
  }
  return other_unit_scale("s", unit);
}

std::optional<double> hertz_in(const std::string& unit) {
  if (unit.empty()) return 1.0;
  constexpr std::array<std::pair<string_view, double>, 4> kPrefixes = {
      {{"", 1.0}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}}};
  constexpr std::array<string_view, 9> kUnits = {
      "Hz", "Sa/s", "S/s", "samples/s", "Samples/s", "sample/s", "Sps", "sps", "SPS"};
  for (const auto& [prefix, factor] : kPrefixes) {
    if (!unit.starts_with(prefix)) continue;
    if (std::ranges::count(kUnits, string_view(unit).substr(prefix.size())) > 0) return factor;
  }
  return std::nullopt;
}

/// One name and its value.
void read_setting(string_view words, const Setting& setting, string_view unit_beside, int line,
                  SamplingSettings& settings) {
  const std::string name = setting_name_of(words);
  std::string unit = setting.unit;
  if (unit.empty()) unit = canonical_unit(unit_beside);
  if (unit.empty()) unit = split_column_name(words).unit;
  const auto found = [&](double period_s) {
    if (settings.period_s || !(period_s > 0.0) || !std::isfinite(period_s)) return;
    settings.period_s = period_s;
    settings.line = line;
  };
  if (is_one_of(kPeriodNames, name)) {
    if (const auto seconds = seconds_in(unit)) found(setting.value * *seconds);
  } else if (is_one_of(kRateNames, name)) {
    if (const auto hertz = hertz_in(unit)) found(1.0 / (setting.value * *hertz));
  } else if (is_one_of(kStartNames, name) && std::isfinite(setting.value)) {
    if (const auto seconds = seconds_in(unit)) settings.start_s = setting.value * *seconds;
  }
}

}  // namespace

bool is_period_name(string_view words) {
  return is_one_of(kPeriodNames, setting_name_of(words));
}

bool is_start_name(string_view words) {
  return is_one_of(kStartNames, setting_name_of(words));
}

SamplingSettings sampling_settings(std::span<const TextLine> lines, char separator, char decimal) {
  SamplingSettings settings;
  LineSplitter splitter(separator == ' ' ? '\t' : separator);
  for (const auto& line : lines) {
    const auto cells = splitter.split(without_comment_mark(line.text));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (const auto mark = cells[i].find_first_of("=:"); mark != string_view::npos) {
        if (const auto setting = setting_in(cells[i].substr(mark + 1), decimal)) {
          read_setting(trimmed(cells[i].substr(0, mark)), *setting, "", line.number, settings);
        }
      }
      if (i + 1 == cells.size()) continue;
      if (const auto setting = setting_in(cells[i + 1], decimal)) {
        const string_view beside = i + 2 < cells.size() ? cells[i + 2] : string_view();
        read_setting(cells[i], *setting, parse_cell(beside, decimal) ? "" : beside, line.number,
                     settings);
      }
    }
  }
  return settings;
}

}  // namespace flexarm::measured
