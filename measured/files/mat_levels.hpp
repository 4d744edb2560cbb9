#pragma once

#include "measured/files/mat_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// Stands behind the name of a text that is not read.
inline constexpr std::string_view kUnreadText =
    "a text with control characters, of many rows or more dimensions";

/// Rows of a text that are read; it is left out with more.
inline constexpr std::size_t kMostTexts = 4096;

/// Numbers of any dimensions, two or more, the first index running fastest.
struct MatNumbers {
  std::vector<std::size_t> dimensions;
  std::vector<double> real;
  std::vector<double> imaginary;  ///< none of a real array
};

/// Adds numbers as a matrix. Of more than two dimensions, those of size 1 are dropped; where more
/// than one is left, each line along the longest of them is a vector of its own, "x(2,3,:)", at
/// most 64 of them.
void add_numbers(const std::string& name, MatNumbers numbers, MatContents& contents);

/// Adds a text of UTF-16 code units, or a list of texts of several rows; the first index of `units`
/// is the row. Rows are as long as each other, with blanks behind.
void add_text(const std::string& name, const std::vector<double>& units, std::size_t rows,
              MatContents& contents);

/// Adds an object of a class that MATLAB alone reads, with the way to save its numbers.
void add_object(const std::string& name, const std::string& class_name, MatContents& contents);

/// "NAME(2)", or "NAME" where there is one element only; `element` is counted from 0.
std::string struct_element_name(const std::string& name, std::size_t elements, std::size_t element);
/// "NAME{2}", "NAME{1,2}"; `element` is counted from 0, down the first column first.
std::string cell_name(const std::string& name, std::size_t rows, std::size_t columns,
                      std::size_t element);

/// Whether bytes are those of a MATLAB file of level 5, 4, or 7.3 (HDF5).
bool is_level5(std::string_view bytes);
bool is_level4(std::string_view bytes);
bool is_level73(std::string_view bytes);
/// Whether bytes are those of an HDF5 file, MATLAB's or not.
bool is_hdf5(std::string_view bytes);

/// The variables of a MATLAB file of that level. Throw InputError for what is cut off or damaged,
/// not located.
MatContents level5_contents(std::string_view bytes);
MatContents level4_contents(std::string_view bytes);
MatContents level73_contents(std::string_view bytes);

}  // namespace flexarm::measured
