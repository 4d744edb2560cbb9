#pragma once

#include "measured/files/universal_modes.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What a function of a universal file is; the file may hold others, by their number.
enum UniversalFunctionType : int {
  kUniversalGeneral = 0,
  kUniversalTimeResponse = 1,
  kUniversalFrequencyResponse = 4,
  kUniversalCoherence = 6,
};

/// An axis of a function: what it shows, the dimension of its unit, and labels of at most 20 bytes.
struct UniversalAxis {
  int quantity = 0;  ///< 17 time, 18 frequency, 8 displacement, 12 acceleration, 13 force, ...
  int length_exponent = 0;
  int force_exponent = 0;
  int temperature_exponent = 0;
  std::string label = "NONE";
  std::string units = "NONE";

  bool operator==(const UniversalAxis&) const = default;
};

/// A degree of freedom: node and direction, 1 to 3 along x, y, z, 4 to 6 about them, negative the
/// other way, 0 scalar.
struct UniversalPlace {
  std::string entity = "NONE";  ///< at most 10 bytes
  int node = 0;
  int direction = 0;

  bool operator==(const UniversalPlace&) const = default;
};

/// Data set 58 of a universal file (Structural Dynamics Research Corporation, revision of 30 June
/// 1999), "function at nodal DOF": ordinates over an abscissa. Vectors are of one length, 1 or
/// more; `imaginary` is empty for real ordinates.
struct UniversalFunction {
  std::array<std::string, 5> id = {"NONE", "NONE", "NONE", "NONE", "NONE"};  ///< 80 bytes each
  int type = kUniversalTimeResponse;
  int number = 0;
  int version = 0;
  int load_case = 0;
  UniversalPlace response;
  UniversalPlace reference;
  double z = 0.0;
  UniversalAxis abscissa_axis;
  UniversalAxis ordinate_axis;
  UniversalAxis denominator_axis;
  UniversalAxis z_axis;
  std::vector<double> abscissa;
  std::vector<double> real;
  std::vector<double> imaginary;

  bool operator==(const UniversalFunction&) const = default;
};

/// The functions and modes of a universal file, and the numbers of the data sets that are neither.
struct UniversalFile {
  std::vector<UniversalFunction> functions;
  std::vector<UniversalMode> modes;
  std::vector<std::string> passed_over;
  std::string units;  ///< of data set 164, as "5, mm (milli-newton)"; empty: SI, or none
};

/// How a universal file is written.
struct UniversalOptions {
  bool binary = false;      ///< data set 58b: 11 lines of text, then the numbers as bytes
  bool big_endian = false;  ///< of those
  bool single_precision = false;
};

/// Reads every data set 55 (measured/files/universal_modes.hpp), 58 and 58b: text and binary (IEEE
/// 754, little and big endian), even and uneven abscissa, real and complex, single and double
/// precision.
///
/// Throws InputError `FILE:LINE: what is wrong` for bytes that are no universal file or are cut
/// off, and for numbers that are none or not finite; lines count as far as the text goes, a fault
/// within bytes is told by its data set. `file_name` stands in the errors.
UniversalFile parse_universal_file(std::string_view bytes, const std::string& file_name);

/// The functions as the bytes of a file, which `parse_universal_file` reads back. In double
/// precision every double comes back bit for bit: binary ones as they are, with an uneven abscissa
/// where the 6 digits of an even one do not make the same; text has 13 digits a number (and 6 for
/// an abscissa), and what these leave stands in data sets of type 0 behind it, whose last ID line
/// begins with "FLEXARM". In single precision ordinates are rounded to 24 bits when binary, to 6
/// digits when text, and an abscissa likewise (an even one to 6 digits of its step).
///
/// Throws std::invalid_argument for vectors of unlike length or none; InputError for a number that
/// is not finite or does not fit.
std::string format_universal_file(const std::vector<UniversalFunction>& functions,
                                  const UniversalOptions& options = {});

/// `format_universal_file` written to `path`, whole or not at all (measured/files/atomic_file.hpp).
void write_universal_file(const std::vector<UniversalFunction>& functions,
                          const std::filesystem::path& path, const UniversalOptions& options = {});

}  // namespace flexarm::measured
