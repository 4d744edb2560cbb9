#include "measured/files/foreign_mat.hpp"
#include "measured/files/memory_file.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

/// Each is read in a process of its own.
constexpr int kMutatedInputs = 5000;

void read_matlab_73(std::string_view bytes) {
  returns_or_refuses([&] {
    const measured::MemoryFile file(bytes);
    import_contents(measured::mat_contents(file.path()));
  });
}

}  // namespace

Reader matlab_73_file() {
  return {"matlab_73_file", read_matlab_73, kMutatedInputs};
}

}  // namespace flexarm::fuzz
