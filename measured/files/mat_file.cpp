#include "measured/files/mat_file.hpp"

#include "arm/ascii.hpp"
#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/memory_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <matio.h>
#include <memory>
#include <new>
#include <set>
#include <stdexcept>
#include <string_view>

namespace flexarm::measured {

namespace {

namespace fs = std::filesystem;

/// The library would put the time and the platform there.
constexpr const char* kHeader = "MATLAB 5.0 MAT-file, written by flexarm";
constexpr std::size_t kLongestName = 63;

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

void require_name(const std::string& name) {
  const bool fits = !name.empty() && name.size() <= kLongestName && arm::is_letter(name.front()) &&
                    std::ranges::all_of(name, [](char c) {
                      return arm::is_letter(c) || arm::is_digit(c) || c == '_';
                    });
  if (!fits)
    throw std::invalid_argument(fmt::format("\"{}\" is not a valid .mat variable name", name));
}

void require_text(const std::string& name, const std::string& text) {
  if (!std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; })) {
    throw std::invalid_argument(fmt::format("{}: a text of a .mat file is printable ASCII", name));
  }
}

template <std::size_t rank = 2>
Variable created(const char* name, matio_classes kind, matio_types type,
                 std::array<std::size_t, rank> size, void* data, int options = 0) {
  Variable variable(Mat_VarCreate(name, kind, type, rank, size.data(), data, options));
  if (!variable) throw std::bad_alloc();
  return variable;
}

Variable text_variable(const char* name, std::string text) {
  return created(name, MAT_C_CHAR, MAT_T_UINT8, {text.empty() ? 0U : 1U, text.size()}, text.data());
}

template <class T>
void require_size(const std::string& name, const MatArray<T>& matrix) {
  if (matrix.values.size() != matrix.rows * matrix.columns) {
    throw std::invalid_argument(fmt::format("{}: {} values for {} x {}", name, matrix.values.size(),
                                            matrix.rows, matrix.columns));
  }
}

void require_size(const std::string& name, const MatPages& pages) {
  if (pages.values.size() != pages.rows * pages.columns * pages.pages) {
    throw std::invalid_argument(fmt::format("{}: {} values for {} x {} x {}", name,
                                            pages.values.size(), pages.rows, pages.columns,
                                            pages.pages));
  }
}

/// Makes the library's variable from one of ours.
struct ToLibrary {
  const std::string& name;

  Variable operator()(const MatMatrix& matrix) const {
    require_size(name, matrix);
    std::vector<double> values = matrix.values;
    return created(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, {matrix.rows, matrix.columns},
                   values.data());
  }
  Variable operator()(const MatComplexMatrix& matrix) const {
    require_size(name, matrix);
    std::vector<double> real;
    std::vector<double> imaginary;
    for (const auto& value : matrix.values) {
      real.push_back(value.real());
      imaginary.push_back(value.imag());
    }
    mat_complex_split_t parts{real.data(), imaginary.data()};
    return created(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, {matrix.rows, matrix.columns}, &parts,
                   MAT_F_COMPLEX);
  }
  Variable operator()(const MatPages& pages) const {
    require_size(name, pages);
    std::vector<double> values = pages.values;
    return created<3>(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE,
                      {pages.rows, pages.columns, pages.pages}, values.data());
  }
  Variable operator()(const std::string& text) const {
    require_text(name, text);
    return text_variable(name.c_str(), text);
  }
  Variable operator()(const MatStrings& texts) const {
    Variable cells =
        created(name.c_str(), MAT_C_CELL, MAT_T_CELL, {texts.size(), std::size_t{1}}, nullptr);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      require_text(name, texts[i]);
      // The cell array owns its cells.
      Mat_VarSetCell(cells.get(), static_cast<int>(i), text_variable(nullptr, texts[i]).release());
    }
    return cells;
  }
};

arm::InputError unusable(const fs::path& path, const std::string& what) {
  return arm::InputError(fmt::format("{}: {}", arm::shown(path.string()), what));
}

/// The library does not check its writes: whether the bytes are those of so many whole variables,
/// each with its size in its tag.
bool holds(std::string_view bytes, std::size_t variables) {
  constexpr std::size_t kHeader_bytes = 128;
  constexpr std::size_t kTag_bytes = 8;
  std::size_t at = kHeader_bytes;
  std::size_t found = 0;
  while (at + kTag_bytes <= bytes.size()) {
    std::uint32_t size = 0;  // in the order of this machine, as the library writes it
    std::memcpy(&size, bytes.data() + at + sizeof size, sizeof size);
    at += kTag_bytes + size;
    ++found;
  }
  return at == bytes.size() && found == variables;
}

}  // namespace

void write_mat_file(const std::vector<MatVariable>& variables, const fs::path& path,
                    std::size_t most_bytes) {
  std::set<std::string_view> names;
  for (const auto& variable : variables) {
    require_name(variable.name);
    if (!names.insert(variable.name).second) {
      throw std::invalid_argument(fmt::format(".mat variable {} is given twice", variable.name));
    }
  }
  const MemoryFile memory;
  File file(Mat_CreateVer(memory.path().c_str(), kHeader, MAT_FT_MAT5));
  bool written = file != nullptr;
  for (const auto& variable : variables) {
    // One at a time: the library keeps a copy of the numbers.
    const Variable converted = std::visit(ToLibrary{variable.name}, variable.value);
    written = written && Mat_VarWrite(file.get(), converted.get(), MAT_COMPRESSION_NONE) == 0;
  }
  written = file != nullptr && Mat_Close(file.release()) == 0 && written;
  const std::string bytes = memory.content();
  if (!written || !holds(bytes, variables.size())) {
    throw unusable(path, "cannot be written: no room for it in memory");
  }
  if (bytes.size() > most_bytes) {
    throw unusable(path, fmt::format("cannot be written: would have {} bytes; at most {}",
                                     bytes.size(), most_bytes));
  }
  write_atomically(path, bytes);
}

}  // namespace flexarm::measured
