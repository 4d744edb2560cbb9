#include "arm/input_error.hpp"
#include "measured/files/mat_file.hpp"
#include "measured/files/mat_levels.hpp"
#include "measured/files/text_encoding.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace flexarm::measured {

namespace {

arm::InputError unreadable_mat(const std::filesystem::path& path, const std::string& what) {
  return arm::InputError(fmt::format("{}: {}", arm::shown(path.string()), what));
}

void add_matrix(const std::string& name, std::size_t rows, std::size_t columns,
                const std::vector<double>& real, const std::vector<double>& imaginary,
                MatContents& contents) {
  if (imaginary.empty()) {
    contents.variables.push_back({name, MatMatrix{rows, columns, real}});
    return;
  }
  MatComplexMatrix matrix{rows, columns, {}};
  for (std::size_t i = 0; i < real.size(); ++i) matrix.values.emplace_back(real[i], imaginary[i]);
  contents.variables.push_back({name, std::move(matrix)});
}

/// "x(2,3,:)" of the line along dimension `along` with number `line`, and its first element.
std::pair<std::string, std::size_t> line_name(const std::string& name,
                                              const std::vector<std::size_t>& dimensions,
                                              std::size_t along, std::size_t line) {
  std::vector<std::string> indices;
  std::size_t first = 0;
  std::size_t stride = 1;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    if (d == along) {
      indices.emplace_back(":");
    } else {
      const std::size_t index = line % dimensions[d];
      line /= dimensions[d];
      first += index * stride;
      indices.push_back(std::to_string(index + 1));
    }
    stride *= dimensions[d];
  }
  return {fmt::format("{}({})", name, fmt::join(indices, ",")), first};
}

}  // namespace

void add_numbers(const std::string& name, MatNumbers numbers, MatContents& contents) {
  auto& dimensions = numbers.dimensions;
  if (dimensions.size() > 2) {
    const auto longer = std::ranges::count_if(dimensions, [](auto size) { return size != 1; });
    if (longer <= 1) dimensions = {numbers.real.size(), 1};
  }
  if (dimensions.size() == 2) {
    add_matrix(name, dimensions[0], dimensions[1], numbers.real, numbers.imaginary, contents);
    return;
  }
  // Of equal ones the last: there the samples are.
  std::size_t along = 0;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    if (dimensions[d] >= dimensions[along]) along = d;
  }
  constexpr std::size_t kMostLines = 64;
  const std::size_t length = dimensions[along];
  const std::size_t lines = length == 0 ? 0 : numbers.real.size() / length;
  if (lines == 0 || lines > kMostLines) {
    contents.left_out.push_back(
        fmt::format("{}: an array of {} numbers", name, fmt::join(dimensions, " x ")));
    return;
  }
  std::size_t stride = 1;
  for (std::size_t d = 0; d < along; ++d) stride *= dimensions[d];
  const auto values_from = [&](std::size_t first, const std::vector<double>& all) {
    std::vector<double> values;
    if (all.empty()) return values;
    for (std::size_t i = 0; i < length; ++i) values.push_back(all[first + i * stride]);
    return values;
  };
  for (std::size_t line = 0; line < lines; ++line) {
    const auto [line_of_array, first] = line_name(name, dimensions, along, line);
    add_matrix(line_of_array, length, 1, values_from(first, numbers.real),
               values_from(first, numbers.imaginary), contents);
  }
}

void add_text(const std::string& name, const std::vector<double>& units, std::size_t rows,
              MatContents& contents) {
  const auto leave_out = [&] {
    contents.left_out.push_back(fmt::format("{}: {}", name, kUnreadText));
  };
  if (rows > kMostTexts) return leave_out();
  MatStrings texts;
  for (std::size_t row = 0; row < std::max<std::size_t>(rows, 1); ++row) {
    std::vector<double> letters;
    for (std::size_t at = row; at < units.size(); at += rows) letters.push_back(units[at]);
    auto text = text_of_units(letters);
    if (!text) return leave_out();
    texts.push_back(std::move(*text));
  }
  MatVariable variable{name, texts.front()};
  if (texts.size() > 1) variable.value = std::move(texts);
  contents.variables.push_back(std::move(variable));
}

void add_object(const std::string& name, const std::string& class_name, MatContents& contents) {
  const std::string object = name.empty() ? "x" : name;
  const std::string way = class_name == "table" || class_name == "timetable"
                              ? fmt::format("s = table2struct({}, 'ToScalar', true)", object)
                              : fmt::format("s.time = {0}.Time; s.data = {0}.Data", object);
  contents.left_out.push_back(
      class_name == "function_handle"
          ? fmt::format("{}: a function", object)
          : fmt::format("{}: an object of class {}, which MATLAB alone reads; save its numbers, as "
                        "in {}; save('log.mat', '-struct', 's')",
                        object, arm::shown(class_name), way));
}

std::string struct_element_name(const std::string& name, std::size_t elements,
                                std::size_t element) {
  return elements == 1 ? name : fmt::format("{}({})", name, element + 1);
}

std::string cell_name(const std::string& name, std::size_t rows, std::size_t columns,
                      std::size_t element) {
  return std::min(rows, columns) <= 1
             ? fmt::format("{}{{{}}}", name, element + 1)
             : fmt::format("{}{{{},{}}}", name, element % rows + 1, element / rows + 1);
}

bool is_mat_file(std::string_view bytes) {
  return is_level5(bytes) || is_level73(bytes) || is_level4(bytes);
}

MatContents read_mat_contents(const std::filesystem::path& path) {
  const std::string bytes = read_text_file(path, kLargestMatFile_bytes);
  try {
    if (is_level5(bytes)) return level5_contents(bytes);
    if (is_level73(bytes)) return level73_contents(bytes);
    if (is_level4(bytes)) return level4_contents(bytes);
  } catch (const arm::InputError& error) {
    throw unreadable_mat(path, error.what());
  }
  throw unreadable_mat(path, "not a MATLAB file");
}

std::vector<MatVariable> read_mat_file(const std::filesystem::path& path) {
  MatContents contents = read_mat_contents(path);
  if (contents.left_out.empty()) return std::move(contents.variables);
  throw unreadable_mat(path, fmt::format("variable {}", contents.left_out.front()));
}

}  // namespace flexarm::measured
