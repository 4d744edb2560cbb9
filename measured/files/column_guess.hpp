#pragma once

#include "measured/files/column_mapping.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A column by what its file tells of it.
struct ColumnLabel {
  std::string name;
  std::string unit;  ///< canonical; empty: not told
  bool is_text = false;  ///< holds no numbers, and is no quantity
};

/// What columns were taken for.
struct ColumnGuess {
  ColumnMappings mappings;         ///< those given, and those guessed
  std::vector<std::string> notes;  ///< a sentence on each quantity that several columns may be, and
                                   ///< each unit that is assumed
};

/// Guesses which of the columns that `given` leaves are time, torque and sensors, by their names
/// without units (the standard names before others in use: t, tau, theta, omega, accelerometer,
/// ...) and their units, which must be the quantity's; one that is not told is taken for SI.
/// A quantity that several columns may be is left out, and noted.
ColumnGuess guess_columns(std::span<const ColumnLabel> columns, const ColumnMappings& given);

}  // namespace flexarm::measured
