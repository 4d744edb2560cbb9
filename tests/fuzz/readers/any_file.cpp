#include "measured/files/file_kind.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void recognise(std::string_view bytes) {
  returns_or_refuses([&] {
    const auto file = measured::recognise_file(bytes);
    if (!file) return;
    require_clean_line(file->is);
    require_clean_line(file->way);
  });
}

}  // namespace

Reader any_file() {
  return {"any_file", recognise};
}

}  // namespace flexarm::fuzz
