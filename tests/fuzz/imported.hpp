#pragma once

#include "measured/files/foreign_file.hpp"

namespace flexarm::fuzz {

/// What `flexarm import` does with a file that has been read: guesses the columns, makes records on
/// an even grid, and writes them. Throws InputError as its steps do, and Finding for a record that
/// is not read back as it was written, or a sentence that is no clean line.
void import_contents(const measured::ForeignFile& file);

}  // namespace flexarm::fuzz
