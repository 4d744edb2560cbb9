#include "measured/files/universal_file.hpp"

#include "measured/files/foreign_file.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_universal(std::string_view bytes) {
  returns_or_refuses([&] {
    const auto read = measured::parse_universal_file(bytes, "file.uff");
    // What is read need not fit into the fields of a file: a node of ten digits with a sign.
    returns_or_refuses([&] {
      const measured::UniversalOptions options{.binary = true};
      const std::string written = measured::format_universal_file(read.functions, options);
      const auto again = measured::parse_universal_file(written, "file.uff");
      require(measured::format_universal_file(again.functions, options) == written,
              "functions are not read back as they were written");
    });
    import_contents(measured::read_foreign_file(file_with(bytes)));
  });
}

}  // namespace

Reader universal_file() {
  return {"universal_file", read_universal};
}

}  // namespace flexarm::fuzz
