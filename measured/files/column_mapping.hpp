#pragma once

#include "arm/sensor.hpp"
#include "measured/files/foreign_table.hpp"
#include "measured/files/time_record.hpp"
#include "measured/files/unit.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// Which column of a foreign log is a quantity, and how its numbers become SI units:
/// value [SI] = number in the column * scale * factor of `unit`. In place of a column, an
/// expression of several (measured/files/column_expression.hpp).
struct ColumnMapping {
  std::string name;    ///< of the column, as `column_place` takes it; empty with an expression
  std::string unit;    ///< one of `units_for` the quantity, or any other, which has no factor: then
                       ///< the scale carries into SI; empty: the SI unit
  double scale = 1.0;  ///< finite and not 0
  std::string expression = {};   ///< in place of the name
  bool is_scale_stated = false;  ///< on the command line, of which a response to no torque asks

  bool operator==(const ColumnMapping&) const = default;
};

/// By standard name: "time", "torque", or a sensor's (`arm::to_string`).
using ColumnMappings = std::map<std::string, ColumnMapping>;

/// The standard name in one spelling, "strain@0.050" as "strain@0.05". Throws InputError with the
/// names allowed for any other.
std::string standard_name(std::string_view name);

/// Whether it is a gauge at 5 m or beyond, where "strain@50" is in mm more often than in m.
bool is_doubtful_place(std::string_view standard_name);

/// The sensor of a standard name; empty for "time" and "torque".
std::optional<arm::Sensor> sensor_of(std::string_view standard_name);

/// "s", "N m", or the sensor's unit.
std::string_view si_unit_of(std::string_view standard_name);

/// The unit of that name among those of the standard name; empty for a foreign one.
std::optional<Unit> unit_of(std::string_view standard_name, std::string_view unit);

/// The scale into SI that a unit stands for where none is given: that of `other_unit_scale`; 1 for
/// any other.
double scale_of_unit(std::string_view standard_name, std::string_view unit);

/// SI units in one of the unit; empty for a foreign one.
std::optional<double> conversion_of(std::string_view standard_name, std::string_view unit);

/// Returns the mapping of `column` by its standard header, `hub_angle [deg]`; nothing for another
/// header, a column that is left out or has no number, and a quantity that is among `mappings`.
ColumnMappings mapping_by_header(const ForeignColumn& column, const ColumnMappings& mappings);

/// Whether a scale beside a unit is that unit's own conversion, to within 1 % and but for its sign,
/// so that it would be applied twice: pi/180 beside deg. Throws InputError for one that is up to 5
/// % off, as a conversion of two digits or with a correction is: 0.0171 beside deg; and for the
/// inverse of the conversion, 180/pi beside deg.
bool repeats_conversion(std::string_view standard_name, std::string_view unit, double scale);

/// Whether numbers in the unit are known in SI without a scale; so is an empty one, which is SI.
bool is_unit_of(std::string_view standard_name, std::string_view unit);

/// The units of which that is so.
std::vector<std::string> unit_names(std::string_view standard_name);

/// Throws InputError for a mapping without a column's name or an expression that can be read, or
/// with both, a scale that is 0 or not finite, and a foreign unit whose scale was not given
/// (`has_scale`).
void require_valid(const std::string& standard_name, const ColumnMapping& mapping, bool has_scale);

/// The standard mapping that a header in the form `hub_angle [rad]` says; none for any other.
ColumnMappings standard_mapping(const std::string& header);

/// The places of the columns that the mappings take, by themselves or in an expression. Throws
/// InputError for a column that is not there.
std::vector<std::size_t> places_used(const ColumnMappings& mappings,
                                     const std::vector<std::string>& names);

/// The record of a foreign log, its times as they are: the columns that `mappings` name, and those
/// that stand under a standard header, `hub_angle [rad]`, in the order of the log; then those that
/// are computed.
///
/// Throws InputError `FILE:LINE: what is wrong` for a column that is not there (with the one that
/// was probably meant) or is there twice, time or torque missing, columns of unlike length, and a
/// cell that is no finite number.
TimeRecord uneven_record_of(const ForeignTable& table, const ColumnMappings& mappings,
                            const std::string& file_name);

/// The reference of a closed loop in such a log, a value a row, in the SI unit of the `sensor` that
/// the controller reads: `mapping` is that of a column of this sensor. `times_s` are those of the
/// rows. Throws InputError `FILE:LINE: reference: ...` as `uneven_record_of`.
Reference reference_of(const ForeignTable& table, const ColumnMapping& mapping,
                       const arm::Sensor& sensor, std::span<const double> times_s,
                       const std::string& file_name);

/// `uneven_record_of`. Throws InputError also for times that `grid_fault` finds fault with.
TimeRecord time_record_of(const ForeignTable& table, const ColumnMappings& mappings,
                          const std::string& file_name);

}  // namespace flexarm::measured
