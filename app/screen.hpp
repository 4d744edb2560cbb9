#pragma once

#include "report/tables/table.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Rows of a table that stay on one screen; more of them are for `--verbose` and for files.
inline constexpr std::size_t kScreenRows = 12;
inline constexpr std::size_t kAllRows = std::numeric_limits<std::size_t>::max();

/// The columns of standard output (report::output_width).
std::size_t screen_width();

/// The table as it fits standard output, with a blank line behind it; empty for one without rows.
std::string screen_table(const report::Table& table, std::size_t key_columns = 1);

/// The same of its first `most` rows, and a line that says how many there are besides and that
/// `where` has them.
std::string screen_rows(const report::Table& table, std::size_t most, const std::string& where,
                        std::size_t key_columns = 1);

/// A paragraph as it fits standard output, at most report::kWidestText columns.
std::string screen_paragraph(std::string_view text, std::size_t indent = 0);

/// What a word stands for; the colour says it to those who see it, the word to all.
enum class Tone { good, bad, warning };

/// `text` with `word` where it occurs first in bold and colour, where standard output shows colour.
std::string toned(std::string text, std::string_view word, Tone tone);

/// A paragraph "note: text" or "warning: text", with its first word toned.
std::string screen_note(std::string_view text, std::string_view kind = "note");

/// "details: WHAT: --verbose"; empty where they are there.
std::string details_line(bool verbose, std::string_view what);

/// `-v,--verbose`: `content` is what it adds.
void add_verbose(CLI::App& parser, bool& verbose, const std::string& content);

}  // namespace flexarm::app
