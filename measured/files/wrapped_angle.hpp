#pragma once

#include "measured/files/foreign_table.hpp"

#include <string>
#include <string_view>

namespace flexarm::measured {

/// Adds whole turns to an angle that is recorded within one, 0 to 360 deg or -180 to 180 deg, and
/// jumps by one from a sample to the next. A number is in `unit`, or `scale` rad where that is no
/// unit of an angle; with neither, the column is none. Returns a sentence on it; empty for a column
/// without such jumps. It stays as it is, and the sentence asks about it, where a step besides is
/// above a quarter turn, or a jump, less its turn, above twice all other steps.
std::string unwrap(ForeignColumn& column, std::string_view unit, double scale = 0.0);

}  // namespace flexarm::measured
