#pragma once

#include <complex>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::measured {

/// rows x columns numbers; `values` column by column, as MATLAB keeps them.
template <class T>
struct MatArray {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<T> values;

  const T& operator()(std::size_t row, std::size_t column) const {
    return values[column * rows + row];
  }
  bool operator==(const MatArray&) const = default;
};

using MatMatrix = MatArray<double>;
using MatComplexMatrix = MatArray<std::complex<double>>;
/// rows x columns x pages numbers, page after page, each column by column.
struct MatPages {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t pages = 0;
  std::vector<double> values;

  bool operator==(const MatPages&) const = default;
};
/// A column of strings, in MATLAB a cell array.
using MatStrings = std::vector<std::string>;

/// A variable of a .mat file: a matrix (a scalar is 1 x 1) or several, a text in UTF-8 (ASCII,
/// where it is written), or a list of texts. Pages are written alone: they are read as vectors.
struct MatVariable {
  std::string name;
  std::variant<MatMatrix, MatComplexMatrix, MatPages, std::string, MatStrings> value;

  bool operator==(const MatVariable&) const = default;
};

/// The largest file that is read.
inline constexpr std::size_t kLargestMatFile_bytes = std::size_t{1} << 30U;

/// Writes a MATLAB 5 file, uncompressed, whole or not at all (measured/files/atomic_file.hpp):
/// MATLAB, GNU Octave and SciPy read it. The same variables give the same bytes.
///
/// Throws InputError when the file cannot be written, or would be larger than `most_bytes`;
/// std::invalid_argument for a name that is not one of MATLAB's (a letter, then letters, digits and
/// _, 63 in all) or is given twice, a matrix whose number of values is not rows x columns, and a
/// text that is not printable ASCII.
void write_mat_file(const std::vector<MatVariable>& variables, const std::filesystem::path& path,
                    std::size_t most_bytes = kLargestMatFile_bytes);

enum class MatLevel { level4, level5, level73 };

/// What a MATLAB file holds.
struct MatContents {
  MatLevel level = MatLevel::level5;
  std::vector<MatVariable> variables;
  std::vector<std::string> left_out;  ///< "NAME: what it is", of what is neither numbers nor text
};

/// Whether bytes are those of a MATLAB file that `read_mat_contents` reads.
bool is_mat_file(std::string_view bytes);

/// The variables of a MATLAB file, in its order: of level 5 (-v6, compressed -v7), 7.3 (HDF5) or 4
/// (-v4). Real and complex matrices of any class of numbers, as doubles; texts, of several rows as
/// lists; columns or rows of texts. The field f of a structure s is a variable "s.f", that of the
/// second of several "s(2).f", the second cell of c "c{2}", or "c{1,2}" where there are several
/// rows and columns. Arrays of more dimensions are vectors along the longest of them, "x(2,3,:)".
///
/// Throws InputError "PATH: what is wrong" for a file that cannot be read, is none, or is damaged.
MatContents read_mat_contents(const std::filesystem::path& path);

/// The same; throws InputError for a variable of another kind, too, by name.
std::vector<MatVariable> read_mat_file(const std::filesystem::path& path);

}  // namespace flexarm::measured
