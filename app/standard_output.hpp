#pragma once

#include <stdexcept>
#include <string_view>

namespace flexarm::app {

/// Whoever read standard output has gone away, as in `flexarm --help | head -1`. The program ends
/// without a word.
struct OutputClosed : std::exception {};

/// Writes to standard output at once. Throws OutputClosed, and std::system_error for any other
/// failure (a full disk).
void print(std::string_view text);

/// From now on `print` writes nothing: standard output is for `print_document`.
void reserve_standard_output();

/// As `print`, whether it is reserved or not.
void print_document(std::string_view document);

}  // namespace flexarm::app
