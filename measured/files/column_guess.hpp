#pragma once

#include "measured/files/column_mapping.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// A column by what its file tells of it.
struct ColumnLabel {
  std::string name;
  std::string unit;       ///< canonical; empty: not told
  bool is_text = false;   ///< holds no numbers, and is no quantity
  bool is_stamp = false;  ///< times of a clock, which are taken where no column has others
  std::string path = {};  ///< where it stands in a file of structures; empty: by name
};

/// The name of a column without its unit and the structure that it is a field of: "torque" of
/// "log.torque.values [N m]".
std::string quantity_name(std::string_view name);

/// Returns the place of the column that `typed` stands for: by its path, else by its name
/// (column_lookup.hpp). Empty where there is none.
std::optional<std::size_t> column_place(std::span<const ColumnLabel> columns,
                                        std::string_view typed);

/// The labels of the columns of a table; one without a number, or left out, is as one of text.
std::vector<ColumnLabel> labels_of(const ForeignTable& table);

/// A column whose name tells what was measured, but not as which quantity it is to be read.
struct ColumnQuestion {
  std::string column;
  std::string sentence;  ///< what it may be, and the option that states it
  bool may_be_torque = false;
};

/// What columns were taken for.
struct ColumnGuess {
  ColumnMappings mappings;         ///< those given, and those guessed
  std::vector<std::string> notes;  ///< a sentence on each quantity that several columns may be, and
                                   ///< each unit that is assumed
  std::vector<std::string> warnings;  ///< a sentence on a torque that its unit alone tells
  /// The columns that may be a quantity, where several may.
  std::map<std::string, std::vector<std::string>> ambiguous;
  std::vector<ColumnQuestion> questions;  ///< on columns that are nothing yet
};

/// Guesses which of the columns that `given` leaves are time, torque and sensors, by their names
/// without units (the standard names before others in use: t, tau, theta, omega, accelerometer,
/// ..., and German and French ones: measured/files/column_words.hpp) and their units, which must be
/// the quantity's; one that is not told is taken for SI. A quantity that several columns may be is
/// left out, and noted. Where no name is that of the torque, the only column in a unit of it is,
/// with a warning, unless its name says that it is another one: "load torque".
ColumnGuess guess_columns(std::span<const ColumnLabel> columns, const ColumnMappings& given);

}  // namespace flexarm::measured
