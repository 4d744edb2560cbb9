#pragma once

#include "importing/imported_file.hpp"
#include "measured/files/foreign_file.hpp"

namespace flexarm::importing {

/// Puts the responses whose columns are typed by their parts in place of those recognised in the
/// table. Throws InputError as `ColumnChoice::response_parts` and `responses_of`.
void take_typed_responses(measured::ForeignFile& file, const FileChoice& choice);

/// Reads the frequency responses of a file, one or more: those of a universal or MATLAB file by
/// their names, those in columns by the name of any of their columns. A sole response that tells no
/// sensor is taken by its unit, or as the hub angle, with a warning. Throws InputError for options
/// of signals in time, and as `frequency_record_of`.
void read_responses(const measured::ForeignFile& file, const FileChoice& choice,
                    ImportedFile& imported);

}  // namespace flexarm::importing
