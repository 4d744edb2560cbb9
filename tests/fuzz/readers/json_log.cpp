#include "measured/files/json_table.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/reader.hpp"

#include <utility>

namespace flexarm::fuzz {

namespace {

void read_json_log(std::string_view bytes) {
  returns_or_refuses([&] {
    measured::JsonTable json = measured::parse_json_table(bytes, "file.json");
    for (const auto& column : json.table.columns) {
      require(column.is_text() || !column.values.empty(), "a column holds nothing");
    }
    measured::ForeignFile contents;
    contents.format = measured::ForeignFormat::json;
    contents.table = std::move(json.table);
    import_contents(std::move(contents));
  });
}

}  // namespace

Reader json_log() {
  return {"json_log", read_json_log};
}

}  // namespace flexarm::fuzz
