#pragma once

#include "arm/sensor.hpp"

#include <complex>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// Frequency response from the commanded torque to one sensor, in the sensor's SI unit per N m. All
/// vectors are of one length, 1 or more.
struct FrequencyChannel {
  arm::Sensor sensor;
  std::vector<double> frequency_Hz;            ///< ascending, 0 or more
  std::vector<std::complex<double>> response;  ///< of exp(+i omega t): Y/tau
  std::vector<double> coherence;               ///< above 0, 1 or less; NaN where unknown

  /// Unknown coherences are equal.
  bool operator==(const FrequencyChannel& other) const;
};

/// Frequency responses of a run, each sensor on frequencies of its own.
struct FrequencyRecord {
  std::vector<FrequencyChannel> channels;  ///< no sensor twice

  bool operator==(const FrequencyRecord&) const = default;
};

/// Reads a frequency record (CSV in long form, docs/formats.md). The columns may stand in any
/// order, rows of different sensors too; `coherence` may be left out.
///
/// Throws InputError with one line `FILE:LINE: what is wrong; what is allowed` for a file that
/// cannot be read or has no rows, a header or row that does not fit, an unknown sensor, a number
/// that is none or out of its range, and a frequency that is not above the sensor's last one.
FrequencyRecord read_frequency_record(const std::filesystem::path& path);

/// The same for the text of a file; `file_name` stands in the errors.
FrequencyRecord parse_frequency_record(std::string_view csv, const std::string& file_name);

/// Throws InputError for a record that no file could hold: vectors of unlike length or none, no
/// channel, a sensor twice, and what `parse_frequency_record` would refuse.
void require_valid(const FrequencyRecord& record);

/// The record as the text of a file, sensor after sensor; `parse_frequency_record` reads the same
/// record back, every double bit for bit. Throws InputError as `require_valid`.
std::string format_frequency_record(const FrequencyRecord& record);

/// `format_frequency_record` written to `path`, whole or not at all
/// (measured/files/atomic_file.hpp).
void write_frequency_record(const FrequencyRecord& record, const std::filesystem::path& path);

}  // namespace flexarm::measured
