#pragma once

#include "measured/files/foreign_table.hpp"

#include <string>
#include <string_view>

namespace flexarm::measured {

/// Whether the text is a LabVIEW measurement file (.lvm) with its head.
bool is_labview_text(std::string_view text);

/// Reads a LabVIEW measurement file of version 1 or 2 [LabviewMeasurement]. Its segments follow
/// each other in the table; each begins where its Date and Time say relative to the first one, or
/// with its own X0 where they do not tell. Times are those of X_Value, and X0 + k Delta_X without.
/// Channels of another X_Value or Delta_X than the first have cells at their own times. Units are
/// those of Y_Unit_Label.
///
/// Throws InputError `FILE:LINE: what is wrong` for a file without samples and for cells that are
/// no numbers.
ForeignTable parse_labview_text(std::string_view text, const std::string& file_name);

}  // namespace flexarm::measured
