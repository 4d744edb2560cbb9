#include "app/screen.hpp"

#include "report/tables/text_table.hpp"
#include "report/terminal.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <unistd.h>

namespace flexarm::app {

namespace {

/// Bold green, red and magenta: legible on light and on dark, as compilers use them.
std::string_view code_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "\x1b[1;32m";
    case Tone::bad:
      return "\x1b[1;31m";
    case Tone::warning:
      return "\x1b[1;35m";
  }
  return "";
}

constexpr std::string_view kPlain = "\x1b[0m";

}  // namespace

std::size_t screen_width() {
  return report::output_width(STDOUT_FILENO);
}

std::string screen_table(const report::Table& table, std::size_t key_columns) {
  if (table.rows.empty()) return "";
  return report::to_text(table, {.max_width = screen_width(), .key_columns = key_columns}) + "\n";
}

std::string screen_rows(const report::Table& table, std::size_t most, const std::string& where,
                        std::size_t key_columns) {
  if (table.rows.size() <= most) return screen_table(table, key_columns);
  std::string text = screen_table(report::first_rows(table, most), key_columns);
  text.pop_back();
  return text +
         screen_paragraph(fmt::format("... and {} more: {}", table.rows.size() - most, where), 4) +
         "\n";
}

std::string screen_paragraph(std::string_view text, std::size_t indent) {
  return report::to_paragraph(text, indent, std::min(screen_width(), report::kWidestText));
}

std::string toned(std::string text, std::string_view word, Tone tone) {
  if (!report::shows_colour(STDOUT_FILENO)) return text;
  const auto at = text.find(word);
  if (at == std::string::npos) return text;
  text.insert(at + word.size(), kPlain);
  text.insert(at, code_of(tone));
  return text;
}

std::string screen_note(std::string_view text, std::string_view kind) {
  const std::string mark = fmt::format("{}:", kind);
  return toned(screen_paragraph(fmt::format("{} {}", mark, text), 2), mark, Tone::warning);
}

std::string details_line(bool verbose, std::string_view what) {
  return verbose ? "" : screen_paragraph(fmt::format("details ({}): --verbose", what));
}

void add_verbose(CLI::App& parser, bool& verbose, const std::string& content) {
  parser.add_flag("-v,--verbose", verbose, content);
}

}  // namespace flexarm::app
