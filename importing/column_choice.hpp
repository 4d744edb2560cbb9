#pragma once

#include "arm/controller.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/complete_rows.hpp"
#include "measured/files/response_columns.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::importing {

/// The column with the reference of a closed loop; it is read like one of the sensor.
struct ReferenceColumn {
  arm::Sensor sensor;
  measured::ColumnMapping mapping;
};

/// Which columns of a foreign file are what, as typed. The reference of a closed loop stands among
/// them under the quantity "reference"; it is none of `mappings`.
struct ColumnChoice {
  std::vector<std::string> typed;     ///< QUANTITY=NAME:UNIT:SCALE
  std::vector<std::string> computed;  ///< QUANTITY [UNIT]=EXPRESSION
  std::string torque;                 ///< an expression, in N m
  std::string time_unit;              ///< in place of that of the file
  std::string reference;              ///< NAME:UNIT:SCALE
  std::vector<std::string> left_out;  ///< names of columns that no quantity is guessed of
  std::vector<std::string> own_rate;  ///< QUANTITY=hold, linear or rows

  /// Whether there is more than names, which frequency responses have too.
  bool is_for_signals() const {
    return !computed.empty() || !torque.empty() || !time_unit.empty() || !reference.empty() ||
           !own_rate.empty();
  }
  bool empty() const { return typed.empty() && left_out.empty() && !is_for_signals(); }

  /// The mappings; what is not typed of a unit is the file's, or SI. A scale is in the unit; one
  /// that is the unit's own conversion is applied once, with a sentence in `notes`. Throws
  /// InputError for what cannot be read, and for columns that are not there (with the one that was
  /// probably meant).
  measured::ColumnMappings mappings(std::span<const measured::ColumnLabel> columns,
                                    std::vector<std::string>& notes) const;

  /// The columns typed as parts of frequency responses: `frequency=NAME:UNIT`,
  /// `SENSOR.magnitude=NAME:UNIT`, `.phase`, `.real`, `.imaginary`, `.coherence`. They are none of
  /// `mappings`. Throws InputError as that.
  std::vector<measured::PartColumn> response_parts(
      std::span<const measured::ColumnLabel> columns) const;

  /// The places of the columns that are left out. Throws InputError for one that is not there.
  std::vector<std::size_t> left_out_places(std::span<const measured::ColumnLabel> columns) const;

  /// Returns how the empty cells of columns at a rate of their own are filled, as --own-rate states
  /// it. Throws InputError for a word or a quantity that is none.
  measured::OwnRates own_rates() const;

  /// The option that states the reference; empty where none does. Throws InputError for two.
  std::string reference_option() const;

  /// The place of the column that is the reference; empty for a computed one. `reference_option`
  /// is not empty. Throws InputError as `mappings`.
  std::optional<std::size_t> reference_place(std::span<const measured::ColumnLabel> columns) const;

  /// The reference of the controller, with the unit that it has in the file. Where none is typed,
  /// unit and scale are those of the sensor that the controller reads first, among `mappings`,
  /// unless the file tells another unit. Throws InputError as `mappings`, and for a unit that is
  /// not the sensor's (of a state space: of none of its sensors).
  ReferenceColumn reference_column(std::span<const measured::ColumnLabel> columns,
                                   const measured::ColumnMappings& mappings,
                                   const arm::Controller& controller,
                                   std::vector<std::string>& notes) const;

  /// Puts `time_unit` into the mapping of the time. Throws InputError for a unit of no time.
  void set_time_unit(measured::ColumnMappings& mappings) const;
};

/// A product of numbers and of pi, as in "0.202*pi/180". Throws InputError for any other text.
double read_scale(std::string_view text);

}  // namespace flexarm::importing
