#pragma once

#include "arm/sensor.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What one sensor read, a value a sample, in the sensor's SI unit (`arm::unit`).
struct Channel {
  arm::Sensor sensor;
  std::vector<double> values;
  /// Samples whose readings are no such, ascending from 0; their values are put there for what
  /// needs one at every sample. No file states any.
  std::vector<std::size_t> left_out = {};

  bool operator==(const Channel&) const = default;
};

/// The name of the column of a time record that has the reference: `reference [rad]`.
inline constexpr std::string_view kReferenceColumn = "reference";

/// What a closed loop was to follow, a value a sample, in an SI unit of the sensors (`arm::unit`).
/// Empty, with an empty unit, where the loop was open.
struct Reference {
  std::string unit;
  std::vector<double> values;

  bool operator==(const Reference&) const = default;
};

/// A run in time, evenly sampled: commanded torque and what the sensors read. All vectors are of
/// one length, 2 or more; without channels it is a torque alone.
struct TimeRecord {
  std::vector<double> time_s;
  std::vector<double> torque_N_m;
  std::vector<Channel> channels;  ///< no sensor twice
  Reference reference = {};

  bool operator==(const TimeRecord&) const = default;
};

/// How far a time may lie from the even grid, in sampling periods:
/// |t_k - (t_0 + k period)| <= 0.05 period. A signal at a tenth of the sampling frequency changes
/// by 3 % of its amplitude in that time.
inline constexpr double kMostJitter_periods = 0.05;

/// The step of the grid that the times lie on: (last - first)/(samples - 1) [s].
double sampling_period_s(const TimeRecord& record);

/// The values of the first sensor of that kind; null without one.
const std::vector<double>* values_of(const TimeRecord& record, arm::SensorKind kind);

/// Reads a time record (CSV, docs/formats.md): `time [s],torque [N m]` and any subset of the
/// sensors, and perhaps `reference`, columns in any order, units as `units_for` has them.
///
/// Throws InputError with one line `FILE:LINE: what is wrong; what is allowed`: for a file that
/// cannot be read or has no samples, a column that is unknown, missing or given twice, an unknown
/// unit, a cell that is no finite number, a time that is not later than the one before, samples
/// that are missing, and jitter above `kMostJitter_periods`.
TimeRecord read_time_record(const std::filesystem::path& path);

/// The same for the text of a file; `file_name` stands in the errors.
TimeRecord parse_time_record(std::string_view csv, const std::string& file_name);

/// The reference of a file that has `time [s]` and `reference [UNIT]`, and perhaps other columns of
/// a time record: a record whose torque is zero and that has no channels. Throws as
/// `read_time_record`.
TimeRecord read_reference(const std::filesystem::path& path);

/// Throws InputError for a record that no file could hold: vectors of unlike length, less than two
/// samples, a value that is not finite, a sensor twice, a reference whose unit is no sensor's, and
/// times as `read_time_record`.
void require_valid(const TimeRecord& record);

/// The record as the text of a file, in SI units; `parse_time_record` reads the same record back,
/// every double bit for bit. Throws InputError as `require_valid`.
std::string format_time_record(const TimeRecord& record);

/// `format_time_record` written to `path`, whole or not at all (measured/files/atomic_file.hpp).
void write_time_record(const TimeRecord& record, const std::filesystem::path& path);

}  // namespace flexarm::measured
