#include "measured/files/universal_file.hpp"

#include "measured/files/foreign_file.hpp"
#include "measured/files/memory_file.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/reader.hpp"

#include <algorithm>
#include <string>

namespace flexarm::fuzz {

namespace {

bool has_same_numbers(const measured::UniversalFunction& a, const measured::UniversalFunction& b) {
  return a.abscissa == b.abscissa && a.real == b.real && a.imaginary == b.imaginary;
}

void read_universal(std::string_view bytes) {
  returns_or_refuses([&] {
    const auto read = measured::parse_universal_file(bytes, "file.uff").functions;
    // What is read need not fit into the fields of a file; numbers that do come back.
    returns_or_refuses([&] {
      const std::string written = measured::format_universal_file(read, {.binary = true});
      const auto again = measured::parse_universal_file(written, "file.uff").functions;
      require(std::ranges::equal(again, read, has_same_numbers),
              "functions are not read back as they were written");
    });
    const measured::MemoryFile file(bytes);
    import_contents(measured::read_foreign_file(file.path()));
  });
}

}  // namespace

Reader universal_file() {
  return {"universal_file", read_universal};
}

}  // namespace flexarm::fuzz
