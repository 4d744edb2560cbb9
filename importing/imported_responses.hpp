#pragma once

#include "importing/imported_file.hpp"
#include "measured/files/foreign_file.hpp"

#include <complex>
#include <span>
#include <string>
#include <vector>

namespace flexarm::importing {

/// Puts the responses whose columns are typed by their parts in place of those recognised in the
/// table. Throws InputError as `ColumnChoice::response_parts` and `responses_of`.
void take_typed_responses(measured::ForeignFile& file, const FileChoice& choice);

/// Reads the frequency responses of a file, one or more: those of a universal or MATLAB file by
/// their names, those in columns by the name of any of their columns. A sole response that tells no
/// sensor is taken by its unit, or as the hub angle, with a warning. Throws InputError for options
/// of signals in time, and as `frequency_record_of`.
///
/// Lines that hold no measurement are left out, with a note; usual signs of such are warned of.
void read_responses(measured::ForeignFile& file, const FileChoice& choice, ImportedFile& imported);

/// Returns `doubtful_signs` of the real and imaginary parts.
std::vector<std::string> doubtful_parts(std::span<const std::complex<double>> response,
                                        const std::string& what);

}  // namespace flexarm::importing
