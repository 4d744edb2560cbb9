#include "measured/files/foreign_mat.hpp"
#include "measured/files/mat_file.hpp"
#include "measured/files/memory_file.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/imported.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_matlab_73(std::string_view bytes) {
  returns_or_refuses([&] {
    const measured::MemoryFile file(bytes);
    for (const auto& variable : measured::read_mat_contents(file.path()).variables) {
      if (const auto* matrix = std::get_if<measured::MatMatrix>(&variable.value)) {
        require(matrix->values.size() == matrix->rows * matrix->columns,
                "a matrix has not as many numbers as its size says");
      }
    }
    import_contents(measured::mat_contents(file.path()));
  });
}

}  // namespace

Reader matlab_73_file() {
  return {"matlab_73_file", read_matlab_73};
}

}  // namespace flexarm::fuzz
