#include "measured/files/foreign_table.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_log(std::string_view bytes) {
  returns_or_refuses([&] {
    measured::ForeignFile file;
    file.table = measured::parse_foreign_table(bytes, "log.txt");
    import_contents(file);
  });
}

}  // namespace

Reader delimited_log() {
  return {"delimited_log", read_log};
}

}  // namespace flexarm::fuzz
