#pragma once

#include "arm/arm.hpp"
#include "arm/option_name.hpp"
#include "measured/run_identification.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::compare {

/// How spectra are estimated and their peaks read off, in a user's words; what is not given is
/// chosen from the data.
struct SpectrumRequest {
  std::string window = {};
  std::optional<double> resolution_Hz = {};
  std::optional<double> overlap_percent = {};
  std::string detrend = {};
  std::string peaks = "between";
};

/// What a user may say of an identification, in words. Errors name an option as `spelled` does.
struct IdentificationRequest {
  std::vector<std::string> runs = {};     ///< ids; empty: all
  std::vector<std::string> sensors = {};  ///< empty: all
  SpectrumRequest spectrum = {};
  std::string input = {};  ///< "torque", "hub_angle", "hub_velocity"; empty: by evidence
  bool fit = true;
  std::optional<int> modes = {};
  std::optional<double> from_Hz = {};
  std::optional<double> to_Hz = {};
  int highest_order = measured::ModalFitOptions{}.highest_order;
  std::optional<double> total_inertia_kg_m2 = {};
  arm::OptionSpelling spelled = arm::on_command_line;
};

/// All that measured::identify and `conditions_of` are given.
struct IdentificationTask {
  measured::Measurement measurement;  ///< with all of its runs
  /// Empty where the measurement states none, or a file in which no number is filled in.
  std::optional<arm::Arm> arm;
  std::vector<measured::MeasuredRun> runs;  ///< those asked for, with the sensors asked for
  measured::IdentificationOptions options;
};

/// Reads the measurement, its arm and the runs asked for. Throws InputError `FILE:LINE: ...` where
/// a reader does, and for what is asked for and not there, or out of its range.
IdentificationTask read_identification_task(const std::filesystem::path& measurement_file,
                                            const IdentificationRequest& request);

/// The same of a measurement in memory.
IdentificationTask identification_task(const std::string& name, const std::optional<arm::Arm>& arm,
                                       const std::vector<measured::MeasuredRun>& runs,
                                       const IdentificationRequest& request);

}  // namespace flexarm::compare
