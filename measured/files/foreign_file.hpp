#pragma once

#include "measured/files/column_mapping.hpp"
#include "measured/files/foreign_response.hpp"
#include "measured/files/foreign_table.hpp"
#include "measured/files/frequency_record.hpp"
#include "measured/files/modal_table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::measured {

enum class ForeignFormat { text, universal, matlab4, matlab5, matlab73, json };

/// "delimited text", "universal file (data set 58)", "MATLAB 5 file", "JSON".
const char* to_string(ForeignFormat format);

/// Contents of a file: signals in time, frequency responses, poles, or several of these.
struct ForeignFile {
  ForeignFormat format = ForeignFormat::text;
  ForeignTable table;  ///< of a text, all; otherwise the signals in time, without columns if none
  std::vector<ForeignResponse> responses;
  ModalTable modes;                   ///< poles of a universal file
  std::vector<std::string> left_out;  ///< what is neither, a phrase each
  std::string incomplete_response;    ///< what a response in columns lacks; empty: there is none
  std::string response_fault;         ///< why a response in columns is not read; empty: none
};

/// Reads a file by what it begins with: a universal file, a MATLAB 5 file, or delimited text.
///
/// Universal files: time responses (function type 1) on the abscissa of the first, frequency
/// responses (4) with their coherences (6), and the poles of modes (data set 55). MATLAB files:
/// vectors, and the columns of matrices, as name(:,k), that are real are signals; complex ones as
/// long as a vector called frequency, freq, f (Hz) or omega, w (rad/s) are responses. What
/// `mat_variables` (measured/files/record_export.hpp) made of a record has the record's names.
///
/// Text and MATLAB files may have responses in columns (measured/files/response_columns.hpp).
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
