#include "app/figure_choice.hpp"

#include "app/command.hpp"
#include "app/list_option.hpp"
#include "arm/ascii.hpp"
#include "arm/input_error.hpp"
#include "report/figures/gnuplot.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace flexarm::app {

namespace {

using report::FigureFormat;

constexpr std::array kFormats = {FigureFormat::svg, FigureFormat::pdf, FigureFormat::png};
constexpr const char* kMinusOne = "minus-one";
constexpr const char* kNegativeFrequencies = "negative-frequencies";
constexpr double kPixelsPerInch = 96.0;
constexpr double kPixelsPerPoint = kPixelsPerInch / 72.0;
constexpr int kLeastSide_px = 100;
constexpr int kLargestSide_px = 10'000;
constexpr double kSmallestFont_pt = 4.0;
constexpr double kLargestFont_pt = 72.0;

constexpr std::array<std::pair<std::string_view, double>, 4> kPixelsPerUnit = {{
    {"mm", kPixelsPerInch / 25.4},
    {"cm", kPixelsPerInch / 2.54},
    {"in", kPixelsPerInch},
    {"px", 1.0},
}};

FigureFormat format_named(const std::string& name) {
  for (const FigureFormat format : kFormats) {
    if (name == report::to_string(format)) return format;
  }
  throw arm::InputError(
      fmt::format("--figure-format {}: must be svg, pdf or png", arm::shown(name)));
}

/// Whether an option has the second of its two values; an empty one has the first.
bool is_second(const char* option, const std::string& value, const char* first,
               const char* second) {
  if (value == second) return true;
  if (value.empty() || value == first) return false;
  throw arm::InputError(
      fmt::format("{} {}: must be {} or {}", option, arm::shown(value), first, second));
}

/// The number that all of `text` is; 0 where it is none.
double number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0.0;
}

/// "160x100mm", "800x600".
report::FigureSize size_in(const std::string& text) {
  std::string_view numbers = text;
  double px_per_unit = 1.0;
  for (const auto& [unit, px] : kPixelsPerUnit) {
    if (!numbers.ends_with(unit)) continue;
    px_per_unit = px;
    numbers.remove_suffix(unit.size());
    break;
  }
  const std::size_t by = numbers.find('x');
  const double width =
      by == std::string_view::npos ? 0.0 : px_per_unit * number_in(numbers.substr(0, by));
  const double height =
      by == std::string_view::npos ? 0.0 : px_per_unit * number_in(numbers.substr(by + 1));
  const auto is_possible = [](double side) {
    return side >= kLeastSide_px && side <= kLargestSide_px;
  };
  if (!is_possible(width) || !is_possible(height)) {
    throw arm::InputError(fmt::format(
        "--figure-size {}: must be WIDTHxHEIGHT in pixels of 1/96 in, or with mm, cm or "
        "in, such as 160x100mm; each side from {} to {} pixels",
        arm::shown(text), kLeastSide_px, kLargestSide_px));
  }
  return {static_cast<int>(std::lround(width)), static_cast<int>(std::lround(height))};
}

/// A family as fontconfig and CSS know it: letters and digits of any script, blanks, '-', '_', '.'.
bool is_font_family(const std::string& name) {
  return !name.starts_with(' ') && std::ranges::all_of(name, [](char c) {
    return arm::is_beyond_ascii(c) || arm::is_letter(c) || arm::is_digit(c) || c == ' ' ||
           c == '-' || c == '_' || c == '.';
  });
}

}  // namespace

void FigureChoice::require_valid(const std::string& folder) const {
  if (folder.empty()) {
    const auto refuse = [](const char* option) {
      throw arm::InputError(fmt::format("{}: needs --out FOLDER", option));
    };
    if (!formats.empty()) refuse("--figure-format");
    if (!size.empty()) refuse("--figure-size");
    if (!font.empty()) refuse("--font");
    if (font_size_pt) refuse("--font-size");
    if (!magnitude.empty()) refuse("--magnitude");
    if (!frequency_unit.empty()) refuse("--frequency-unit");
    if (!nyquist.empty()) refuse("--nyquist");
    return;
  }
  options();
  nyquist_marks();
  report::run_gnuplot("");  // throws where there is none
}

report::FigureOptions FigureChoice::options() const {
  report::FigureOptions options;
  if (!formats.empty()) options.formats.clear();
  for (const std::string& name : formats) {
    const FigureFormat format = format_named(name);
    if (std::ranges::count(options.formats, format) == 0) options.formats.push_back(format);
  }
  if (!size.empty()) options.size = size_in(size);
  if (!font.empty()) {
    if (!is_font_family(font)) {
      throw arm::InputError(fmt::format(
          "--font {}: must be the name of a font family, such as Helvetica", arm::shown(font)));
    }
    options.font = font;
  }
  if (font_size_pt) {
    if (!(*font_size_pt >= kSmallestFont_pt && *font_size_pt <= kLargestFont_pt)) {
      throw arm::out_of_range("--font-size", *font_size_pt, "pt",
                              fmt::format("from {} to {}", kSmallestFont_pt, kLargestFont_pt));
    }
    options.font_size_px = kPixelsPerPoint * *font_size_pt;
  }
  if (is_second("--magnitude", magnitude, "absolute", "dB")) {
    options.magnitude = report::MagnitudeScale::decibel;
  }
  if (is_second("--frequency-unit", frequency_unit, "Hz", "rad/s")) {
    options.frequency = report::FrequencyUnit::radians_per_second;
  }
  return options;
}

report::NyquistMarks FigureChoice::nyquist_marks() const {
  report::NyquistMarks marks;
  for (const std::string& name : nyquist) {
    const bool is_negative = is_second("--nyquist", name, kMinusOne, kNegativeFrequencies);
    (is_negative ? marks.negative_frequencies : marks.minus_one) = true;
  }
  return marks;
}

void FigureChoice::add_to(std::vector<measured::NamedContent>& files,
                          const std::filesystem::path& folder,
                          const std::vector<report::NamedFigure>& figures) const {
  for (auto& [name, content] : report::figure_files(figures, options())) {
    files.push_back({folder / name, std::move(content)});
  }
}

void add_figure_choice(CLI::App& parser, FigureChoice& choice) {
  add_list_option(parser, "--figure-format", choice.formats,
                  "Formats of figures: svg, pdf, png, comma-separated [svg]");
  parser
      .add_option("--figure-size", choice.size,
                  "WIDTHxHEIGHT of figures, in pixels or with a unit: 160x100mm")
      ->check(not_empty());
  parser.add_option("--font", choice.font, "Font family of figures [sans-serif]")
      ->check(not_empty());
  parser.add_option("--font-size", choice.font_size_pt, "Font size of figures in points [10]");
  parser
      .add_option("--magnitude", choice.magnitude,
                  "Magnitudes of frequency responses in figures: absolute or dB [absolute]")
      ->check(not_empty());
  parser
      .add_option("--frequency-unit", choice.frequency_unit,
                  "Unit of frequency axes of figures: Hz or rad/s [Hz]")
      ->check(not_empty());
  add_list_option(parser, "--nyquist", choice.nyquist,
                  "Shown in Nyquist diagrams besides: minus-one, negative-frequencies, "
                  "comma-separated");
}

}  // namespace flexarm::app
