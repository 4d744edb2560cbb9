#pragma once

#include "arm/arm.hpp"
#include "arm/deadline.hpp"
#include "compare/measured_responses.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace flexarm::app {

/// What `compare --measured` takes: a modal table, a frequency record, a universal or MATLAB file
/// with responses under the names of sensors, or a measurement.
struct MeasuredFile {
  std::vector<measured::Run> runs;           ///< one without an id for a file by itself
  std::vector<measured::RunData> data;       ///< of each
  std::vector<std::filesystem::path> files;  ///< that were read
  std::filesystem::path arm_file = {};       ///< that a measurement names; empty of other files

  /// There are runs, and all are time runs.
  bool is_in_time() const;
  /// The sensors whose zeros its tables have.
  std::vector<arm::Sensor> sensors_with_zeros() const;
};

/// Throws InputError as the readers do.
MeasuredFile read_measured_file(const std::string& file);

/// The runs of an arm beside its comparison: those without a payload, those with the payload of
/// the arm, and, where the arm is `alone`, `time` runs with any payload, which they are simulated
/// with. `whole` has all effects, which measured responses and signals contain. After the deadline
/// nothing is simulated. `after_run` is called after each run.
compare::MeasuredComparison beside_models(const MeasuredFile& measured, const arm::Arm& whole,
                                          const compare::Comparison& comparison, bool alone,
                                          const arm::Deadline& deadline,
                                          const std::function<void()>& after_run);

}  // namespace flexarm::app
