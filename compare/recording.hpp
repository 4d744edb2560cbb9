#pragma once

#include "arm/arm.hpp"
#include "measured/files/run_data.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::compare {

/// A measurement with its arm and what its runs measured, read from files or given in memory.
struct Recording {
  std::string name;
  arm::Arm arm;
  std::vector<measured::MeasuredRun> runs;
  std::filesystem::path file = {};                ///< the measurement file; empty: in memory
  std::vector<std::filesystem::path> files = {};  ///< all that was read

  /// Returns what stands in front of errors: the file, or "measurement".
  std::string place() const;
  /// The same of a run: its file, or "measurement".
  std::string place(const measured::Run& run) const;
};

/// Reads a measurement file, its arm and the files of its runs. Throws InputError `FILE:LINE: ...`
/// where a reader does; the arm is not checked.
Recording read_recording(const std::filesystem::path& measurement_file);

/// Throws InputError for no run, an id that two runs have, and as `measured::require_valid` for the
/// data of a run.
void require_valid(const Recording& recording);

}  // namespace flexarm::compare
