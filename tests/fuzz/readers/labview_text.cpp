#include "measured/files/labview_text.hpp"

#include "measured/files/foreign_file.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_labview(std::string_view bytes) {
  returns_or_refuses([&] {
    measured::ForeignFile file;
    file.table = measured::parse_labview_text(bytes, "log.lvm");
    import_contents(file);
  });
}

}  // namespace

Reader labview_text() {
  return {"labview_text", read_labview};
}

}  // namespace flexarm::fuzz
