#pragma once

#include "arm/sensor.hpp"

#include <complex>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// Frequency response from the input of the record to one sensor, in the sensor's SI unit per SI
/// unit of the input. All vectors are of one length, 1 or more.
struct FrequencyChannel {
  arm::Sensor sensor;
  std::vector<double> frequency_Hz;            ///< ascending, 0 or more
  std::vector<std::complex<double>> response;  ///< of exp(+i omega t): Y/U
  std::vector<double> coherence;               ///< above 0, 1 or less; NaN where unknown

  /// Unknown coherences are equal.
  bool operator==(const FrequencyChannel& other) const;
};

/// Frequency responses of a run, each sensor on frequencies of its own.
struct FrequencyRecord {
  std::vector<FrequencyChannel> channels;  ///< no sensor twice, and not the input
  /// The hub angle or velocity that is the input, whatever moves the hub; empty: the commanded
  /// torque.
  std::optional<arm::Sensor> input = {};

  bool operator==(const FrequencyRecord&) const = default;
};

/// Reads a frequency record (CSV in long form, docs/formats.md). The columns may stand in any
/// order, rows of different sensors too; `coherence` and `input` may be left out.
///
/// Throws InputError with one line `FILE:LINE: what is wrong; what is allowed` for a file that
/// cannot be read or has no rows, a header or row that does not fit, an unknown sensor, a number
/// that is none or out of its range, a frequency that is not above the sensor's last one, and an
/// input that is no motion of the hub, differs between rows, or is a sensor of the record.
FrequencyRecord read_frequency_record(const std::filesystem::path& path);

/// The same for the text of a file; `file_name` stands in the errors.
FrequencyRecord parse_frequency_record(std::string_view csv, const std::string& file_name);

/// Returns the input of that name, as FrequencyRecord::input: "torque", "hub_angle",
/// "hub_velocity". Throws InputError for any other name.
std::optional<arm::Sensor> parse_response_input(std::string_view name);
std::string name_of_input(const FrequencyRecord& record);

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
