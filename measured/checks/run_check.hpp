#pragma once

#include "arm/deadline.hpp"
#include "arm/payload.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/files/run_data.hpp"
#include "measured/files/time_record.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// The arm of a measurement as its file describes it.
struct DescribedArms {
  arm::Payload payload;       ///< of a run that states none
  double beam_mass_kg = 0.0;  ///< 0: no beam
  /// What `check_data` may know of it with a payload; empty: nothing is described.
  std::function<DataCheckOptions(const arm::Payload& payload)> with = {};
};

/// A run that `check_data` has been through.
struct CheckedRun {
  std::string id;
  const TimeRecord* record = nullptr;
  arm::Payload payload;  ///< as stated
  bool starts_at_rest = true;
  std::vector<DataFinding> findings = {};
};

/// A finding by comparison of runs.
struct RunFinding {
  std::size_t run = 0;
  DataFinding finding;
};

/// What runs say of each other: a payload that is another than stated, and the noise of a channel
/// that is a multiple of that in the other runs (check_noise_between_runs). The payload with which
/// the described arm is nearest to a run (described_distance) differs from what is stated in this
/// run alone. What the arm file has wrong for all runs is no finding.
///
/// Runs with a finding in their times are left out, and channels with one. For payloads, runs with
/// one in their torque are left out as well.
/// A fault that the deadline leaves undecided is not found.
std::vector<RunFinding> check_runs(const std::vector<CheckedRun>& runs, const DescribedArms& arms,
                                   const arm::Deadline& deadline = {});

/// The findings of `check_data` and `check_runs`, a list a run; empty for what is no `time` run.
/// After the deadline nothing more is checked.
std::vector<std::vector<DataFinding>> check_records(std::span<const MeasuredRun> runs,
                                                    const DescribedArms& arms,
                                                    const arm::Deadline& deadline = {});

}  // namespace flexarm::measured
