#pragma once

#include "arm/sensor.hpp"
#include "measured/files/foreign_table.hpp"
#include "measured/files/time_record.hpp"
#include "measured/files/unit.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// Which column of a foreign log is a quantity, and how its numbers become SI units:
/// value [SI] = number in the column * scale * factor of `unit`.
struct ColumnMapping {
  std::string name;    ///< of the column, as the log has it
  std::string unit;    ///< one of `units_for` the quantity, or any other, which has no factor: then
                       ///< the scale carries into SI; empty: the SI unit
  double scale = 1.0;  ///< finite and not 0

  bool operator==(const ColumnMapping&) const = default;
};

/// By standard name: "time", "torque", or a sensor's (`arm::to_string`).
using ColumnMappings = std::map<std::string, ColumnMapping>;

/// The standard name in one spelling, "strain@0.050" as "strain@0.05". Throws InputError with the
/// names allowed for any other.
std::string standard_name(std::string_view name);

/// The sensor of a standard name; empty for "time" and "torque".
std::optional<arm::Sensor> sensor_of(std::string_view standard_name);

/// "s", "N m", or the sensor's unit.
std::string_view si_unit_of(std::string_view standard_name);

/// The unit of that name among those of the standard name; empty for a foreign one.
std::optional<Unit> unit_of(std::string_view standard_name, std::string_view unit);

/// Throws InputError for a mapping without a column's name, a scale that is 0 or not finite, and a
/// foreign unit whose scale was not given (`has_scale`).
void require_valid(const std::string& standard_name, const ColumnMapping& mapping, bool has_scale);

/// The standard mapping that a header in the form `hub_angle [rad]` says; none for any other.
ColumnMappings standard_mapping(const std::string& header);

/// The record of a foreign log: the columns that `mappings` name, and those that stand under a
/// standard header, `hub_angle [rad]`, in the order of the log.
///
/// Throws InputError `FILE:LINE: what is wrong` for a column that is not there (with the one that
/// was probably meant) or is there twice, time or torque missing, columns of unlike length, a cell
/// that is no finite number, and times that `grid_fault` finds fault with.
TimeRecord time_record_of(const ForeignTable& table, const ColumnMappings& mappings,
                          const std::string& file_name);

}  // namespace flexarm::measured
