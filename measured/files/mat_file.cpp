#include "measured/files/mat_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/mat_elements.hpp"
#include "measured/files/memory_file.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <matio.h>
#include <memory>
#include <new>
#include <optional>
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

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

void require_name(const std::string& name) {
  const bool fits = !name.empty() && name.size() <= kLongestName && is_letter(name.front()) &&
                    std::ranges::all_of(name, [](char c) {
                      return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
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

std::size_t elements(const matvar_t& variable) {
  return variable.dims[0] * variable.dims[1];
}

/// A text of one row.
bool read_text(const matvar_t& variable, std::string& text) {
  if (variable.class_type != MAT_C_CHAR || variable.rank != 2) return false;
  const std::size_t size = elements(variable);
  if (size > 0 && (variable.dims[0] != 1 || variable.data == nullptr)) return false;
  text.clear();
  for (std::size_t i = 0; i < size; ++i) {
    const unsigned code = variable.data_size == 1
                              ? static_cast<const std::uint8_t*>(variable.data)[i]
                              : static_cast<const std::uint16_t*>(variable.data)[i];
    if (variable.data_size > 2 || code < ' ' || code > '~') return false;
    text += static_cast<char>(code);
  }
  return true;
}

bool read_texts(const matvar_t& variable, MatStrings& texts) {
  if (variable.class_type != MAT_C_CELL || variable.rank != 2) return false;
  if (elements(variable) > 0 && std::min(variable.dims[0], variable.dims[1]) != 1) return false;
  const auto* cells = static_cast<matvar_t* const*>(variable.data);
  for (std::size_t i = 0; i < elements(variable); ++i) {
    if (cells == nullptr || cells[i] == nullptr || !read_text(*cells[i], texts.emplace_back())) {
      return false;
    }
  }
  return true;
}

/// What the library keeps of numbers, as doubles. Integers above 2^53 are rounded.
template <class Stored>
std::vector<double> doubles(const void* data, std::size_t size) {
  const auto* values = static_cast<const Stored*>(data);
  std::vector<double> converted(size);
  for (std::size_t i = 0; i < size; ++i) converted[i] = static_cast<double>(values[i]);
  return converted;
}

std::optional<std::vector<double>> doubles_of(matio_types type, const void* data,
                                              std::size_t size) {
  if (size == 0) return std::vector<double>();
  if (data == nullptr) return std::nullopt;
  switch (type) {
    case MAT_T_DOUBLE:
      return doubles<double>(data, size);
    case MAT_T_SINGLE:
      return doubles<float>(data, size);
    case MAT_T_INT8:
      return doubles<std::int8_t>(data, size);
    case MAT_T_UINT8:
      return doubles<std::uint8_t>(data, size);
    case MAT_T_INT16:
      return doubles<std::int16_t>(data, size);
    case MAT_T_UINT16:
      return doubles<std::uint16_t>(data, size);
    case MAT_T_INT32:
      return doubles<std::int32_t>(data, size);
    case MAT_T_UINT32:
      return doubles<std::uint32_t>(data, size);
    case MAT_T_INT64:
      return doubles<std::int64_t>(data, size);
    case MAT_T_UINT64:
      return doubles<std::uint64_t>(data, size);
    default:
      return std::nullopt;
  }
}

bool read_numbers(const matvar_t& variable, MatVariable& read) {
  if (variable.class_type < MAT_C_DOUBLE || variable.class_type > MAT_C_UINT64 ||
      variable.rank != 2) {
    return false;
  }
  const std::size_t size = elements(variable);
  if (variable.isComplex == 0) {
    auto values = doubles_of(variable.data_type, variable.data, size);
    if (!values) return false;
    read.value = MatMatrix{variable.dims[0], variable.dims[1], std::move(*values)};
    return true;
  }
  if (variable.data == nullptr) return false;
  const auto* parts = static_cast<const mat_complex_split_t*>(variable.data);
  const auto real = doubles_of(variable.data_type, parts->Re, size);
  const auto imaginary = doubles_of(variable.data_type, parts->Im, size);
  if (!real || !imaginary) return false;
  MatComplexMatrix matrix{variable.dims[0], variable.dims[1], {}};
  for (std::size_t i = 0; i < size; ++i) matrix.values.emplace_back((*real)[i], (*imaginary)[i]);
  read.value = std::move(matrix);
  return true;
}

/// Adds the variable under `name`, or the fields of a structure under names with a point.
void append(matvar_t& variable, const std::string& name, MatContents& contents) {
  MatVariable read{name, {}};
  std::string text;
  MatStrings texts;
  if (variable.class_type == MAT_C_STRUCT && variable.rank == 2 && elements(variable) == 1) {
    const unsigned fields = Mat_VarGetNumberOfFields(&variable);
    char* const* names = Mat_VarGetStructFieldnames(&variable);
    for (unsigned i = 0; i < fields; ++i) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
      if (field != nullptr) append(*field, fmt::format("{}.{}", name, names[i]), contents);
    }
    return;
  }
  if (read_text(variable, text)) {
    read.value = std::move(text);
  } else if (read_texts(variable, texts)) {
    read.value = std::move(texts);
  } else if (!read_numbers(variable, read)) {
    contents.left_out.push_back(name);
    return;
  }
  contents.variables.push_back(std::move(read));
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

MatContents read_mat_contents(const fs::path& path) {
  const std::string bytes = read_text_file(path, kLargestMatFile_bytes);
  constexpr std::string_view kMagic = "MATLAB 5.0 MAT-file";
  if (!bytes.starts_with(kMagic)) {
    throw unusable(path, "not a MATLAB 5 file; save with -v6 or -v7");
  }
  MatElements sound;
  try {
    sound = sound_elements(bytes);
  } catch (const arm::InputError& error) {
    throw unusable(path, error.what());
  }
  const MemoryFile memory(sound.file);
  File file(Mat_Open(memory.path().c_str(), MAT_ACC_RDONLY));
  if (!file || Mat_GetVersion(file.get()) != MAT_FT_MAT5) {
    throw unusable(path, "not a MATLAB 5 file; save with -v6 or -v7");
  }
  MatContents contents{{}, std::move(sound.left_out)};
  for (;;) {
    const Variable variable(Mat_VarReadNext(file.get()));
    if (!variable) return contents;
    append(*variable, variable->name == nullptr ? "" : variable->name, contents);
  }
}

std::vector<MatVariable> read_mat_file(const fs::path& path) {
  MatContents contents = read_mat_contents(path);
  if (contents.left_out.empty()) return std::move(contents.variables);
  throw unusable(path, fmt::format("variable {} is neither a matrix of numbers nor text",
                                   arm::shown(contents.left_out.front())));
}

}  // namespace flexarm::measured
