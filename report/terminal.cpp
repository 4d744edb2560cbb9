#include "report/terminal.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace flexarm::report {
namespace {

/// Empty where it is not set.
std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

/// 0: the descriptor is no terminal, or one that does not know its size.
std::size_t terminal_columns(int descriptor) {
  winsize size{};
  if (::isatty(descriptor) != 1 || ::ioctl(descriptor, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col;
}

/// 0: COLUMNS is not a whole number.
std::size_t stated_columns() {
  const std::string_view text = environment("COLUMNS");
  unsigned short columns = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), columns);
  return error == std::errc() && end == text.data() + text.size() ? columns : 0;
}

}  // namespace

std::size_t output_width(int descriptor) {
  std::size_t columns = terminal_columns(descriptor);
  if (columns == 0) columns = stated_columns();
  if (columns == 0) columns = kPipeWidth;
  return std::max(columns, kLeastWidth);
}

bool takes_escape_sequences(int descriptor) {
  const std::string_view kind = environment("TERM");
  return !kind.empty() && kind != "dumb" && ::isatty(descriptor) == 1;
}

bool shows_colour(int descriptor) {
  return environment("NO_COLOR").empty() && takes_escape_sequences(descriptor);
}

}  // namespace flexarm::report
