#pragma once

#include "arm/controller.hpp"
#include "importing/imported_file.hpp"
#include "measured/files/measurement.hpp"

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace flexarm::importing {

/// Which runs are made of a file, and how its times are treated; as typed.
struct RunsChoice {
  std::string id;
  std::string rows;
  std::string times;
  std::vector<std::string> runs;  ///< ID=FROM:TO [s] or ID=rows:FROM:TO
  std::optional<int> decimation;
  std::string clock = "stamped";
  int longest_filled_gap = 3;
  std::string hold;     ///< empty: zero, and first after decimation
  std::string initial;  ///< empty: rest, and free where the record does not begin with the file's
  std::string purpose;
  std::vector<std::string> validation;  ///< ids of runs
  std::optional<double> payload_mass_kg;
  std::optional<double> payload_inertia_kg_m2;
  std::optional<arm::Controller> controller;  ///< that made the torque of the files' references
};

/// A run of a measurement with its data.
struct ImportedRun {
  measured::Run run;
  measured::RunData data;
  std::string source;              ///< the file
  std::vector<std::string> notes;  ///< what was done to the data, a sentence each
};

/// Throws InputError for what cannot be read, and for what does not go together.
void require_valid(const RunsChoice& choice, std::size_t files);

/// The runs of a file; `used_ids` are those of runs made before, and gets the new ones. A run in
/// closed loop begins with a sample of the controller: the first sample of the file, and every
/// period of the controller from there.
/// Throws InputError for a range without samples, what cannot be put on an even grid, and a
/// controller whose period is no whole multiple of the record's.
std::vector<ImportedRun> runs_of(const ImportedFile& file, const RunsChoice& choice,
                                 std::set<std::string>& used_ids);

/// Gives the runs their purposes. Throws InputError for an id that no run has.
void set_purposes(std::vector<ImportedRun>& runs, const RunsChoice& choice);

}  // namespace flexarm::importing
