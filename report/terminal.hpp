#pragma once

#include <cstddef>
#include <string_view>

namespace flexarm::report {

/// Columns of text that does not go to a terminal, unless COLUMNS says otherwise: files and pipes
/// are the same everywhere.
inline constexpr std::size_t kPipeWidth = 100;
/// A narrower terminal is written to as if it had this many columns.
inline constexpr std::size_t kLeastWidth = 24;
/// Running text is not made wider than this: longer lines are hard to read.
inline constexpr std::size_t kWidestText = 100;

/// Columns of a line written to `descriptor`: those of the terminal that it is; else the
/// environment variable COLUMNS, where it is a whole number above 0; else kPipeWidth. At least
/// kLeastWidth.
std::size_t output_width(int descriptor);

/// Whether `descriptor` is a terminal that understands escape sequences: TERM is neither empty nor
/// "dumb".
bool takes_escape_sequences(int descriptor);

/// On such a terminal: to the first column of the line, which is then empty.
inline constexpr std::string_view kWipeLine = "\r\x1b[K";

/// Whether `descriptor` is a terminal that shows colours: it takes escape sequences, and NO_COLOR
/// is not set or empty (no-color.org).
bool shows_colour(int descriptor);

}  // namespace flexarm::report
