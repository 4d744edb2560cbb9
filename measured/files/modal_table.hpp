#pragma once

#include "arm/sensor.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

enum class Feature { pole, zero };

/// "pole" or "zero".
std::string_view to_string(Feature feature);

/// One measured pole or zero of the transfer function from torque to `sensor`; what is not known is
/// empty.
struct ModalEntry {
  std::optional<arm::Sensor> sensor;  ///< given for every zero; a pole is the same in all
  Feature feature = Feature::pole;
  /// Flexible ones counted from 1; empty: not known, compare/root_numbering.hpp assigns one.
  std::optional<int> order;
  std::optional<double> frequency_Hz;  ///< undamped natural frequency abs(s)/(2 pi), above 0
  std::optional<double> frequency_std_Hz;
  std::optional<double> damping_ratio;  ///< -Re s/abs(s), -1 to 1; below 0 on the right half plane
  std::optional<double> damping_ratio_std;
  /// Of a pole: value of its mode shape at the sensor, before time derivatives, in a scale that all
  /// rows of the pole share. The imaginary part is 0 unless given.
  std::optional<double> shape_re = {};
  std::optional<double> shape_im = {};

  bool operator==(const ModalEntry&) const = default;
};

/// Measured poles and zeros, in the order of their file.
using ModalTable = std::vector<ModalEntry>;

/// Reads a modal table (CSV, docs/formats.md). The columns may stand in any order; those that may
/// be empty may be left out.
///
/// Throws InputError with one line `FILE:LINE: what is wrong; what is allowed` for a file that
/// cannot be read, a header or row that does not fit, an unknown sensor or feature, a number that
/// is none or out of its range, and a pole or zero that is given twice. Of a file of another kind
/// it says what is `required`, where other kinds are taken as well.
ModalTable read_modal_table(const std::filesystem::path& path, const std::string& required = {});

/// The same for the text of a file; `file_name` stands in the errors.
ModalTable parse_modal_table(std::string_view csv, const std::string& file_name);

/// Throws InputError "entry 2: ..." for a table that no file could hold, as `parse_modal_table` for
/// its rows.
void require_valid(const ModalTable& table);

/// The table as the text of a file; `parse_modal_table` reads the same table back, every double
/// bit for bit.
std::string format_modal_table(const ModalTable& table);

/// `format_modal_table` written to `path`, whole or not at all (measured/files/atomic_file.hpp).
void write_modal_table(const ModalTable& table, const std::filesystem::path& path);

}  // namespace flexarm::measured
