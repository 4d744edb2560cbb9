#pragma once

#include "measured/files/foreign_table.hpp"

namespace flexarm::measured {

/// A table in long form, with rows of a time, the name of a signal, its value and perhaps its unit,
/// as one with a column for each signal: at the times of all, ascending, NaN where a signal has no
/// value. Numbers of channels, most times with several, are names: "channel 1". Any other table as
/// it is.
///
/// Throws InputError for a signal with two values at one time, or in two units.
ForeignTable without_long_form(ForeignTable table);

}  // namespace flexarm::measured
