#include "app/standard_output.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace flexarm::app {

namespace {

/// Of the program, as standard output is.
bool is_reserved = false;

}  // namespace

void reserve_standard_output() {
  is_reserved = true;
}

void print(std::string_view text) {
  if (!is_reserved) print_document(text);
}

void print_document(std::string_view text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written) return;
  if (errno == EPIPE) throw OutputClosed();
  throw std::system_error(errno, std::generic_category(), "standard output");
}

}  // namespace flexarm::app
