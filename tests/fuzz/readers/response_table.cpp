#include "measured/files/foreign_file.hpp"
#include "measured/files/memory_file.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

/// Tables whose columns are parts of frequency responses.
void read_responses(std::string_view bytes) {
  returns_or_refuses([&] {
    const measured::MemoryFile file(bytes);
    import_contents(measured::read_foreign_file(file.path()));
  });
}

}  // namespace

Reader response_table() {
  return {"response_table", read_responses};
}

}  // namespace flexarm::fuzz
