#include "arm/input_error.hpp"
#include "arm/utf8.hpp"
#include "measured/files/mat_elements.hpp"
#include "measured/files/mat_levels.hpp"
#include "measured/files/memory_file.hpp"
#include "measured/files/text_encoding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <matio.h>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

struct CloseRead {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeRead {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

std::size_t elements(const matvar_t& variable) {
  std::size_t product = 1;
  for (int i = 0; i < variable.rank; ++i) product *= variable.dims[i];
  return product;
}

/// The UTF-16 or Latin-1 of a matrix of letters, column by column; empty of any other variable, and
/// of letters that are kept in another way.
std::vector<double> text_units(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || variable.rank != 2) return {};
  const std::size_t size = elements(variable);
  const auto unit_bytes = static_cast<std::size_t>(variable.data_size);
  const bool is_known = variable.data != nullptr && (unit_bytes == 1 || unit_bytes == 2);
  if (!is_known || variable.nbytes != size * unit_bytes) return {};
  std::vector<double> units;
  for (std::size_t i = 0; i < size; ++i) {
    units.push_back(unit_bytes == 1 ? static_cast<const std::uint8_t*>(variable.data)[i]
                                    : static_cast<const std::uint16_t*>(variable.data)[i]);
  }
  return units;
}

/// A text of one row: UTF-8, whose letters have a byte or more, UTF-16 or Latin-1. Some programs
/// call Latin-1 UTF-8.
bool read_text(const matvar_t& variable, std::string& text) {
  if (variable.class_type != MAT_C_CHAR || variable.rank != 2) return false;
  text.clear();
  if (elements(variable) == 0) return true;
  if (variable.dims[0] != 1 || variable.data == nullptr) return false;
  const auto* bytes = static_cast<const char*>(variable.data);
  if (variable.data_type == MAT_T_UTF8) text.assign(bytes, variable.nbytes);
  const auto is_printed = [](char c) {
    return static_cast<unsigned char>(c) >= ' ' && c != '\x7f';
  };
  if (!text.empty() && arm::is_utf8(text)) return std::ranges::all_of(text, is_printed);
  const auto units = text_units(variable);
  auto read = text_of_units(units);
  if (read) text = std::move(*read);
  return read.has_value() && !units.empty();
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

/// The numbers of an array; empty for one of another class.
std::optional<MatNumbers> read_numbers(const matvar_t& variable) {
  if (variable.class_type < MAT_C_DOUBLE || variable.class_type > MAT_C_UINT64) {
    return std::nullopt;
  }
  const std::size_t size = elements(variable);
  MatNumbers numbers{{variable.dims, variable.dims + variable.rank}, {}, {}};
  if (variable.isComplex == 0) {
    auto values = doubles_of(variable.data_type, variable.data, size);
    if (!values) return std::nullopt;
    numbers.real = std::move(*values);
    return numbers;
  }
  if (variable.data == nullptr) return std::nullopt;
  const auto* parts = static_cast<const mat_complex_split_t*>(variable.data);
  auto real = doubles_of(variable.data_type, parts->Re, size);
  auto imaginary = doubles_of(variable.data_type, parts->Im, size);
  if (!real || !imaginary) return std::nullopt;
  numbers.real = std::move(*real);
  numbers.imaginary = std::move(*imaginary);
  return numbers;
}

void append(matvar_t& variable, const std::string& name, MatContents& contents);

void append_struct(matvar_t& variable, const std::string& name, MatContents& contents) {
  const unsigned fields = Mat_VarGetNumberOfFields(&variable);
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  const std::size_t count = elements(variable);
  for (std::size_t k = 0; k < count; ++k) {
    const std::string element = struct_element_name(name, count, k);
    for (unsigned i = 0; i < fields; ++i) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, k);
      if (field != nullptr) append(*field, fmt::format("{}.{}", element, names[i]), contents);
    }
  }
}

void append_cells(const matvar_t& variable, const std::string& name, MatContents& contents) {
  const auto* cells = static_cast<matvar_t* const*>(variable.data);
  const std::size_t rows = variable.dims[0];
  for (std::size_t k = 0; cells != nullptr && k < elements(variable); ++k) {
    if (cells[k] == nullptr) continue;
    append(*cells[k], cell_name(name, rows, elements(variable) / rows, k), contents);
  }
}

/// Adds the variable under `name`, or what it holds under names with points and indices.
void append(matvar_t& variable, const std::string& name, MatContents& contents) {
  std::string text;
  MatStrings texts;
  if (variable.class_type == MAT_C_STRUCT) {
    append_struct(variable, name, contents);
  } else if (read_text(variable, text)) {
    contents.variables.push_back({name, std::move(text)});
  } else if (read_texts(variable, texts)) {
    contents.variables.push_back({name, std::move(texts)});
  } else if (variable.class_type == MAT_C_CELL) {
    append_cells(variable, name, contents);
  } else if (auto numbers = read_numbers(variable)) {
    add_numbers(name, std::move(*numbers), contents);
  } else if (const auto units = text_units(variable); !units.empty()) {
    add_text(name, units, variable.dims[0], contents);
  } else if (variable.class_type == MAT_C_CHAR) {
    contents.left_out.push_back(fmt::format("{}: {}", name, kUnreadText));
  } else {
    contents.left_out.push_back(fmt::format("{}: neither numbers nor text", name));
  }
}

}  // namespace

bool is_level5(std::string_view bytes) {
  return bytes.starts_with("MATLAB 5.0 MAT-file");
}

MatContents level5_contents(std::string_view bytes) {
  MatElements sound = sound_elements(bytes);
  const MemoryFile memory(sound.file);
  const std::unique_ptr<mat_t, CloseRead> file(Mat_Open(memory.path().c_str(), MAT_ACC_RDONLY));
  if (!file || Mat_GetVersion(file.get()) != MAT_FT_MAT5) {
    throw arm::InputError("is damaged: no MATLAB 5 file");
  }
  MatContents contents{MatLevel::level5, {}, std::move(sound.left_out)};
  for (const auto& object : sound.objects) {
    add_object(object.name, object.class_name, contents);
  }
  for (;;) {
    const std::unique_ptr<matvar_t, FreeRead> variable(Mat_VarReadNext(file.get()));
    if (!variable) return contents;
    // Data of the objects have no name.
    const bool is_named = variable->name != nullptr && *variable->name != '\0';
    if (is_named) append(*variable, variable->name, contents);
  }
}

}  // namespace flexarm::measured
