#pragma once

#include "arm/arm.hpp"
#include "arm/deadline.hpp"
#include "compare/recording.hpp"
#include "diagnose/measured_motion.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/run_identification.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A fault of a run that the user knows to be none.
struct AcceptedFinding {
  std::string run;
  measured::DataFinding finding;
};

/// An arm as its file describes it, and what was measured on it.
struct Experiment {
  arm::Arm arm;
  /// `time`, `frf` and `modal` runs, all of which have a purpose and at least one usable reading;
  /// every entry of a modal table has an order.
  std::vector<measured::MeasuredRun> runs;
  std::vector<std::filesystem::path> files;  ///< that it was read from
  std::vector<std::string> notices;          ///< what was assumed or left out, a sentence each
  std::vector<AcceptedFinding> accepted;     ///< faults that count as none
  /// Of an experiment that is driven by motion (driven_by_motion), one a run, all of which are
  /// `time` runs: the hub turns like that, whatever the torque. Else empty.
  std::vector<MeasuredMotion> motions = {};
  /// Whether the torque that the motions take is judged by the recorded one, in a channel behind
  /// those of the sensors (balanced_at_hub).
  bool judges_torque = false;
};

/// The arm of a run: with the run's payload in place of its own where it has one.
arm::Arm arm_in(const Experiment& experiment, const measured::Run& run);

/// Returns whether a run is of this kind and for this purpose.
bool has_runs(const Experiment& experiment, measured::Purpose purpose, measured::RunKind kind);

/// Whether any run states the controller that made its torque; and the experiment with none that
/// does: its torque is then what was recorded.
bool has_controllers(const Experiment& experiment);
Experiment without_controllers(Experiment experiment);

/// Whether the hub's motion is the input of the runs.
inline bool is_driven_by_motion(const Experiment& experiment) {
  return !experiment.motions.empty();
}

/// Whether every `time` run says what its torque does between samples; and the experiment with
/// those that do not taken for saying `hold`.
bool holds_are_known(const Experiment& experiment);
Experiment with_hold(Experiment experiment, measured::TorqueHold hold);

/// Reads the measurement, its arm and the files of its runs.
///
/// Channels that are dead are left out, with a notice, and so are readings that are outliers
/// (measured::leave_out_spikes). A finding of the data checks `accepted` has
/// no such consequence, and is among Experiment::accepted in the place of the notices. Where no run
/// is for validation the conditions (payload, kind, torque) are split, with a notice
/// (`split_purposes`). Long runs are cut, with notices (diagnose/long_runs.hpp). Entries of modal
/// tables get the orders that they do not state (diagnose/modal_orders.hpp).
///
/// After the deadline the data are not checked any more, with a notice.
///
/// Throws InputError `FILE:LINE: ...` where a reader does, for a run with a torque that is zero or
/// with no usable channel or entry, and for runs none of which is for estimation.
Experiment read_experiment(const std::filesystem::path& measurement_file,
                           const std::vector<measured::Fault>& accepted = {},
                           const arm::Deadline& deadline = {});

/// The same of a recording that was read or is in memory.
Experiment experiment_of(compare::Recording recording,
                         const std::vector<measured::Fault>& accepted = {},
                         const arm::Deadline& deadline = {});

/// Gives every run without a purpose one. Runs that say nothing are for estimation where another
/// is for validation. Where none is, the last run of a payload is, of the payload with most runs;
/// a single run stays for estimation. Returns what was done, or nothing.
std::string split_purposes(std::vector<measured::MeasuredRun>& runs);

}  // namespace flexarm::diagnose
