#pragma once

#include "arm/option_name.hpp"
#include "arm/time_limit.hpp"
#include "diagnose/diagnosis.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// What a user may say of a diagnosis, in words. Errors name an option as `spelled` does.
struct DiagnosisRequest {
  std::vector<std::string> effects = {};   ///< to test; empty: all of the library
  std::vector<std::string> excluded = {};  ///< "sensor_gain", "sensor_gain on tip_acceleration"
  std::vector<std::string> accepted = {};  ///< data checks whose faults count as none
  std::optional<double> time_limit_s = {};
  std::optional<int> most_causes = {};  ///< any number unless given
  std::string predictor = "auto";       ///< or a PredictorKind
  /// Numbers of the search that are not as in search/policy.hpp: "NAME=NUMBER".
  std::vector<std::string> policy = {};
  arm::OptionSpelling spelled = arm::on_command_line;
};

/// The end of a diagnosis that began then (arm::deadline_of).
Deadline deadline_of(const DiagnosisRequest& request, std::chrono::steady_clock::time_point begun);

/// The experiment of a recording, with the accepted faults. Throws InputError for a check that
/// there is not, and as `experiment_of(recording, faults, deadline)`.
Experiment experiment_of(compare::Recording recording, const DiagnosisRequest& request,
                         const Deadline& deadline = {});

/// Throws InputError for a number of causes below 1, an unknown predictor and a number of the
/// search that there is not.
void require_valid(const DiagnosisRequest& request);

/// Returns the diagnosis that is asked for, by a search that ends kReportTime before the deadline,
/// or halfway to it. Throws InputError as `require_valid`, for an effect that is unknown or that
/// these runs do not show, and where kReportTime after the deadline not even the arm as filed has
/// been simulated.
Diagnosis diagnose(const Experiment& experiment, const DiagnosisRequest& request,
                   const Deadline& deadline, const DiagnosisProgress& progress = {});

/// Whether there is an extended arm to write: an incomplete search that names no cause has none.
bool has_extended_arm(const Diagnosis& diagnosis);

}  // namespace flexarm::diagnose
