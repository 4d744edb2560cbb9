#include "measured/files/modal_table.hpp"

#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_modal_table_text(std::string_view bytes) {
  returns_or_refuses([&] {
    const auto read = measured::parse_modal_table(bytes, "file.csv");
    require(measured::parse_modal_table(measured::format_modal_table(read), "file.csv") == read,
            "a modal table is not read back as it was written");
  });
}

}  // namespace

Reader modal_table() {
  return {"modal_table", read_modal_table_text};
}

}  // namespace flexarm::fuzz
