#pragma once

#include "arm/arm.hpp"
#include "compare/measured_responses.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::app {

/// What `compare --measured` takes: a modal table, a frequency record, a universal or MATLAB file
/// with responses under the names of sensors, or a measurement with runs of kind modal or frf.
struct MeasuredFile {
  std::vector<measured::Run> runs;           ///< one without an id for a file by itself
  std::vector<measured::RunData> data;       ///< of each
  std::vector<std::filesystem::path> files;  ///< that were read
  std::vector<std::string> notes;            ///< on runs that are left out, a sentence each

  /// The sensors whose zeros its tables have.
  std::vector<arm::Sensor> sensors_with_zeros() const;
};

/// Throws InputError as the readers do, and for a measurement without such a run.
MeasuredFile read_measured_file(const std::string& file);

/// The runs of an arm beside its comparison: those without a payload, and those with the payload of
/// the arm. `whole` has the effects of actuator and sensors, which measured responses contain.
compare::MeasuredComparison beside_models(const MeasuredFile& measured, const arm::Arm& whole,
                                          const compare::Comparison& comparison);

}  // namespace flexarm::app
