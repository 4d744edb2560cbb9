#pragma once

#include "measured/files/column_guess.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Which columns of a foreign file are what, as typed.
struct ColumnChoice {
  std::vector<std::string> typed;     ///< QUANTITY=NAME:UNIT:SCALE
  std::vector<std::string> computed;  ///< QUANTITY [UNIT]=EXPRESSION
  std::string torque;                 ///< an expression, in N m
  std::string time_unit;              ///< in place of that of the file

  /// Whether there is more than names, which frequency responses have too.
  bool is_for_signals() const {
    return !computed.empty() || !torque.empty() || !time_unit.empty();
  }
  bool empty() const { return typed.empty() && !is_for_signals(); }

  /// The mappings; what is not typed of a unit is the file's, or SI. Throws InputError for what
  /// cannot be read, and for columns that are not there (with the one that was probably meant).
  measured::ColumnMappings mappings(std::span<const measured::ColumnLabel> columns) const;

  /// Puts `time_unit` into the mapping of the time. Throws InputError for a unit of no time.
  void set_time_unit(measured::ColumnMappings& mappings) const;
};

/// Adds `--column`, `--compute`, `--torque` and `--time-unit` to a command.
void add_column_choice(CLI::App& parser, ColumnChoice& choice);

/// A product of numbers and of pi, as in "0.202*pi/180". Throws InputError for any other text.
double read_scale(std::string_view text);

}  // namespace flexarm::app
