#pragma once

#include "measured/files/column_mapping.hpp"
#include "measured/files/foreign_table.hpp"
#include "measured/files/frequency_record.hpp"

#include <complex>
#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A frequency response of a file that was not made for this program. Vectors are of one length.
struct ForeignResponse {
  std::string name;
  std::string unit;  ///< of the response, canonical; empty: not told
  std::string per;   ///< unit of what it is a response to; empty: not told
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> response;
  std::vector<double> coherence;  ///< NaN where unknown
};

enum class ForeignFormat { text, universal, matlab4, matlab5, matlab73, json };

/// "delimited text", "universal file (data set 58)", "MATLAB 5 file", "JSON".
const char* to_string(ForeignFormat format);

/// What a file holds: signals in time, frequency responses, or both.
struct ForeignFile {
  ForeignFormat format = ForeignFormat::text;
  ForeignTable table;  ///< of a text, all; otherwise the signals in time, without columns if none
  std::vector<ForeignResponse> responses;
  std::vector<std::string> left_out;  ///< what is neither, a phrase each
};

/// Reads a file by what it begins with: a universal file, a MATLAB 5 file, or delimited text.
///
/// Universal files: time responses (function type 1) on the abscissa of the first, frequency
/// responses (4) with their coherences (6). MATLAB files: vectors, and the columns of matrices, as
/// name(:,k), that are real are signals; complex ones as long as a vector called frequency, freq,
/// f (Hz) or omega, w (rad/s) are responses. What `mat_variables`
/// (measured/files/record_export.hpp) made of a record has the record's names.
///
/// Throws InputError as the readers do, and `FILE: ...` for a file without either.
ForeignFile read_foreign_file(const std::filesystem::path& path);

/// The responses that `mappings` name and those named by a standard header, `hub_angle [rad]`, in
/// SI: value in the file * scale * factor of the unit / factor of the torque's unit (`per`). A
/// torque of a foreign unit asks for a scale that carries into SI per N m.
///
/// Throws InputError `FILE: what is wrong`.
FrequencyRecord frequency_record_of(const ForeignFile& file, const ColumnMappings& mappings,
                                    const std::string& file_name);

}  // namespace flexarm::measured
